#include "anatomy/import/units_and_axes.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace palpa::anatomy {
namespace {

constexpr std::array<Unit, 6> kUnits{{{"m", "metres", 1},
                                      {"mm", "millimetres", 1e-3},
                                      {"cm", "centimetres", 1e-2},
                                      {"um", "micrometres", 1e-6},
                                      {"in", "inches", 0.0254},
                                      {"ft", "feet", 0.3048}}};

struct SizeRange {
  double least, most;  // m, of the longest side
};

SizeRange spanOf(Organ organ) {
  switch (organ) {
    case Organ::clavicle:
      return {0.10, 0.20};
    case Organ::rib:
      return {0.05, 0.45};
    case Organ::sternum:
      return {0.04, 0.27};
    case Organ::scapula:
      return {0.09, 0.24};
    case Organ::spine:
      return {0.01, 0.80};
    case Organ::cartilage:
      return {0.01, 0.30};
    case Organ::airway:
      return {0.05, 0.40};
    case Organ::lung:
      return {0.12, 0.40};
    case Organ::muscle:
      return {0.03, 0.50};
    case Organ::vein:
    case Organ::artery:
      return {0.02, 1.20};
    case Organ::inclusion:
      return {0.002, 0.20};
    default:
      return {0.10, 2.40};  // skin: a piece of chest to a whole body
  }
}

}  // namespace

std::optional<Unit> unitNamed(const std::string& name) {
  for (const Unit& unit : kUnits)
    if (name == unit.name) return unit;
  return std::nullopt;
}

std::string knownUnits() {
  std::string names;
  for (const Unit& unit : kUnits) names += (names.empty() ? "" : ", ") + std::string(unit.name);
  return names;
}

bool plausibleLength(Organ organ, double longest_m) {
  const SizeRange span = spanOf(organ);
  return longest_m >= span.least && longest_m <= span.most;
}

std::optional<Unit> likelyUnit(Organ organ, double longest) {
  for (const Unit& unit : kUnits)
    if (plausibleLength(organ, longest * unit.metres)) return unit;
  return std::nullopt;
}

std::string lengthText(double metres) {
  struct Scale {
    double from, metres;
    const char* name;
  };
  static constexpr Scale kScales[] = {
      {1000, 1000, "km"}, {1, 1, "m"}, {1e-3, 1e-3, "mm"}, {0, 1e-6, "um"}};
  char text[32];
  for (const Scale& scale : kScales)
    if (std::abs(metres) >= scale.from) {
      std::snprintf(text, sizeof text, "%.3g %s", metres / scale.metres, scale.name);
      return text;
    }
  return "no length";
}

namespace {

std::optional<Vec3> directionNamed(char letter) {
  switch (letter) {
    case 'L':
      return Vec3(1, 0, 0);
    case 'R':
      return Vec3(-1, 0, 0);
    case 'P':
      return Vec3(0, 1, 0);
    case 'A':
      return Vec3(0, -1, 0);
    case 'S':
      return Vec3(0, 0, 1);
    case 'I':
      return Vec3(0, 0, -1);
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<FileAxes> axesNamed(const std::string& letters) {
  if (letters.size() != 3) return std::nullopt;
  FileAxes axes;
  for (int i = 0; i < 3; ++i) {
    const std::optional<Vec3> direction = directionNamed(letters[static_cast<std::size_t>(i)]);
    if (!direction) return std::nullopt;
    axes.A_from_file.col(i) = *direction;
  }
  if (std::abs(axes.A_from_file.determinant()) < 0.5) return std::nullopt;  // a direction twice
  return axes;
}

}  // namespace palpa::anatomy

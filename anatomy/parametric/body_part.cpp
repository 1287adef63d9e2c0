#include "anatomy/parametric/body_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "anatomy/base/random.h"
#include "anatomy/parametric/phantoms.h"

namespace palpa::anatomy {
namespace {

using Eigen::Vector2d;
using Tone = Eigen::Vector3d;  // sRGB, 0..1

constexpr double kStep = 0.003;      // m, between the sheet's points
constexpr double kRunOut = 0.040;    // m, from the block's top into the part's form
constexpr double kOffTable = 0.001;  // m
constexpr int kPicture = 384;        // pixels a side
const Tone kSkin(0.87, 0.68, 0.58), kAreola(0.63, 0.38, 0.34), kFold(0.66, 0.46, 0.39),
    kGland(0.80, 0.47, 0.44), kWall(0.87, 0.60, 0.56), kFurrow(0.70, 0.37, 0.36);

/// 0 up to `from`, 1 from `to` on, without a kink.
double rise(double at, double from, double to) {
  const double u = std::clamp((at - from) / (to - from), 0.0, 1.0);
  return u * u * u * (10 + u * (6 * u - 15));
}

double bell(double at, double wide) { return std::exp(-0.5 * at * at / (wide * wide)); }

/// A form about the block: how far it goes, how high it is, how it looks. Heights from the origin.
struct Form {
  Vector2d half;  ///< m
  double (*height)(double x, double y, double high);
  Tone (*tone)(double x, double y);
};

double breastHeight(double x, double y, double high) {
  const double chest = -high + 0.008 - 0.02 * std::pow(x / 0.13, 2);
  return chest * rise(std::hypot(x, y), 0.034, 0.112);
}
Tone breastTone(double x, double y) {
  const double r = std::hypot(x, y), nipple = bell(r, 0.0035);
  Tone tone = kSkin + (kAreola - kSkin) * (1 - rise(r, 0.015, 0.019));
  tone += nipple * (kFold - kAreola) * 0.7;
  return tone;
}

constexpr double kNavelX = 0.062, kNavelY = -0.066;

double abdomenHeight(double x, double y, double high) {
  const double flank = 0.55 * high * rise(std::hypot(x / 0.15, y / 0.19), 0.25, 1);
  const double margin = 0.010 * bell(y - 0.085 + 0.35 * x, 0.018);  // ribs end here
  const double navel = 0.007 * bell(std::hypot(x - kNavelX, y - kNavelY), 0.007);
  return -flank + margin - navel;
}
Tone abdomenTone(double x, double y) {
  const double navel = bell(std::hypot(x - kNavelX, (y - kNavelY) / 1.3), 0.006);
  const double line = 0.25 * bell(x - kNavelX, 0.003);  // linea alba
  return kSkin + (kFold - kSkin) * std::min(navel + line, 1.0);
}

/// Below 0 inside of the gland's outline: wide at its base, a notch there.
double fromGland(double x, double y) {
  const double wide = 0.025 + 0.02 * (y + 0.020);
  const double notch = 0.006 * bell(x, 0.007) * rise(y, 0, 0.02);
  return std::hypot(x / wide, (y + notch) / 0.020) - 1;
}
double prostateHeight(double x, double y, double high) {
  const double wall = -0.30 * high + 0.35 * high * std::pow(x / 0.07, 2);
  const double bulge = 1 - rise(fromGland(x, y), -0.15, 0.55);
  return wall * (1 - bulge);
}
Tone prostateTone(double x, double y) {
  const double gland = 1 - rise(fromGland(x, y), -0.1, 0.25);
  const double furrow = gland * bell(x, 0.0022) * (1 - rise(y, 0.008, 0.018));
  return kWall + (kGland - kWall) * gland + 0.8 * (kFurrow - kGland) * furrow;
}

double neckHeight(double x, double y, double high) {
  const double side = 0.058 + 0.10 * rise(-y, 0.045, 0.115);  // it widens to the shoulders
  const double vault = std::min(std::abs(x) / side, 1.0);
  const double round = high * (1 - std::sqrt(1 - 0.98 * vault * vault));
  const double jaw = 0.034 * rise(y, 0.056, 0.088) * bell(x, 0.050);
  const double notch = 0.008 * bell(std::hypot(x / 1.6, y + 0.078), 0.011);
  return -round + jaw - notch;
}
Tone neckTone(double x, double y) {
  const double notch = 0.3 * bell(std::hypot(x / 1.6, y + 0.078), 0.011);
  const double crease = 0.18 * bell(y - 0.058 + 2.0 * x * x, 0.0016);
  return kSkin + (kFold - kSkin) * std::min(notch + crease, 1.0);
}

Form formOf(BodyPart part) {
  switch (part) {
    case BodyPart::breast:
      return {{0.145, 0.135}, breastHeight, breastTone};
    case BodyPart::abdomen:
      return {{0.165, 0.145}, abdomenHeight, abdomenTone};
    case BodyPart::prostate:
      return {{0.066, 0.062}, prostateHeight, prostateTone};
    case BodyPart::neck:
      break;
  }
  return {{0.120, 0.120}, neckHeight, neckTone};
}

class Sheet {
 public:
  Sheet(BodyPart part, const TopShape& top, const Vector2d& half, double high)
      : form_(formOf(part)), top_(top), half_(half), high_(high) {}

  OrganSurface surface() const {
    OrganSurface organ{"body_part", Organ::skin, {}};
    const int across = stepsAlong(0), away = stepsAlong(1);
    for (int j = 0; j <= away; ++j)
      for (int i = 0; i <= across; ++i) {
        const double u = 2.0 * i / across - 1, v = 2.0 * j / away - 1;
        // From a square to an ellipse (Nowell's mapping): a body has no corners.
        add(form_.half.x() * u * std::sqrt(1 - 0.5 * v * v),
            form_.half.y() * v * std::sqrt(1 - 0.5 * u * u), &organ.mesh);
      }
    const auto index = [&](int i, int j) { return std::uint32_t(j * (across + 1) + i); };
    for (int j = 0; j < away; ++j)
      for (int i = 0; i < across; ++i) {
        organ.mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
        organ.mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
      }
    organ.texture = picture();
    return organ;
  }

 private:
  int stepsAlong(int axis) const { return int(std::lround(2 * form_.half[axis] / kStep)); }

  double height(double x, double y) const {
    const double beyond =
        std::hypot(std::max(std::abs(x) - half_.x(), 0.0), std::max(std::abs(y) - half_.y(), 0.0));
    const double block = heightOf(top_, std::clamp(x, -half_.x() - kRunOut, half_.x() + kRunOut),
                                  std::clamp(y, -half_.y() - kRunOut, half_.y() + kRunOut))
                             .z;
    if (beyond == 0) return block;
    const double form = form_.height(x, y, high_), away = rise(beyond, 0, kRunOut);
    return std::max(std::lerp(block, form, away), -high_ + kOffTable);
  }

  void add(double x, double y, TriangleMesh* mesh) const {
    constexpr double kNear = 5e-4;
    const Vec3 normal_P = Vec3(height(x - kNear, y) - height(x + kNear, y),
                               height(x, y - kNear) - height(x, y + kNear), 2 * kNear)
                              .normalized();
    mesh->points.push_back(X_AP() * Vec3(x, y, height(x, y)));
    mesh->normals.push_back(X_AP().linear() * normal_P);
    mesh->uvs.push_back(
        {float(0.5 + 0.5 * x / form_.half.x()), float(0.5 + 0.5 * y / form_.half.y())});
  }

  /// Its tone with a mottling of some millimetres; row 0 at the near edge.
  RgbPicture picture() const {
    constexpr int kPatches = 24;
    RandomStream random(1, "body_part");
    std::array<double, (kPatches + 1) * (kPatches + 1)> patch{};
    for (double& value : patch) value = 0.014 * random.normal();
    const auto mottling = [&](double u, double v) {
      const double a = u * kPatches, b = v * kPatches;
      const auto i = std::min(int(a), kPatches - 1), j = std::min(int(b), kPatches - 1);
      const auto value = [&](int di, int dj) {
        return patch[std::size_t((j + dj) * (kPatches + 1) + i + di)];
      };
      return std::lerp(std::lerp(value(0, 0), value(1, 0), a - i),
                       std::lerp(value(0, 1), value(1, 1), a - i), b - j);
    };
    RgbPicture result{kPicture, kPicture, {}};
    for (int row = 0; row < kPicture; ++row)
      for (int column = 0; column < kPicture; ++column) {
        const double u = (column + 0.5) / kPicture, v = (row + 0.5) / kPicture;
        const Tone tone = form_.tone((2 * u - 1) * form_.half.x(), (2 * v - 1) * form_.half.y()) *
                          (1 + mottling(u, v));
        for (int k = 0; k < 3; ++k)
          result.rgb.push_back(std::uint8_t(std::lround(255 * std::clamp(tone[k], 0.0, 1.0))));
      }
    return result;
  }

  Form form_;
  TopShape top_;
  Vector2d half_;
  double high_;
};

}  // namespace

std::optional<BodyPart> bodyPartNamed(const std::string& word) {
  constexpr std::array<std::pair<const char*, BodyPart>, 4> kNames{
      {{"breast", BodyPart::breast},
       {"abdomen", BodyPart::abdomen},
       {"prostate", BodyPart::prostate},
       {"neck", BodyPart::neck}}};
  for (const auto& [name, part] : kNames)
    if (word == name) return part;
  return std::nullopt;
}

OrganSurface bodyPart(BodyPart part, const TopShape& top, const Vector2d& half, double high) {
  return Sheet(part, top, half, high).surface();
}

}  // namespace palpa::anatomy

#include "anatomy/import/axes.h"

#include <cmath>

namespace palpa::anatomy {
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

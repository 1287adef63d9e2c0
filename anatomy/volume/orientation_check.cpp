#include "anatomy/volume/orientation_check.h"

#include <algorithm>
#include <cmath>

namespace palpa::anatomy {
namespace {

constexpr double kClearOff = 0.003, kClearRatio = 1.6, kSpineHalf = 0.035, kBeside = 0.06;
constexpr double kEnds = 0.3;  // of the height

char turned(char letter) {
  switch (letter) {
    case 'P':
      return 'A';
    case 'A':
      return 'P';
    case 'S':
      return 'I';
    case 'I':
      return 'S';
    default:
      return letter;
  }
}

struct Found {
  double spine_behind = 0;      ///< metres
  double above = 0, below = 0;  ///< bone beside the spine near either end
};

Found look(const Volume& volume, const Levels& levels) {
  const double stride_mm = 3;
  Index3 by{};
  for (std::size_t a = 0; a < 3; ++a)
    by[a] = std::max(1, static_cast<int>(stride_mm * 1e-3 / volume.spacing()[static_cast<int>(a)]));
  struct Sum {
    double x = 0, y = 0, count = 0;
  } soft, spine;
  const auto visit = [&](auto use) {
    for (int k = 0; k < volume.size[2]; k += by[2])
      for (int j = 0; j < volume.size[1]; j += by[1])
        for (int i = 0; i < volume.size[0]; i += by[0])
          use(volume.at(i, j, k), volume.pointToS(Vec3(i, j, k)));
  };
  visit([&](double value, const Vec3& p) {
    if (value > levels.soft) soft.x += p.x(), soft.y += p.y(), ++soft.count;
  });
  if (soft.count == 0) return {};
  const double middle = soft.x / soft.count;
  const Vec3 one = volume.pointToS(Vec3::Zero());
  const Vec3 other =
      volume.pointToS(Vec3(volume.size[0] - 1, volume.size[1] - 1, volume.size[2] - 1));
  const double low = std::min(one.z(), other.z()), height = std::abs(one.z() - other.z());
  Found found;
  visit([&](double value, const Vec3& p) {
    if (value < levels.bone) return;
    const double off = std::abs(p.x() - middle), up = (p.z() - low) / height;
    if (off < kSpineHalf) spine.y += p.y(), ++spine.count;
    if (off > kBeside && up > 1 - kEnds) ++found.above;
    if (off > kBeside && up < kEnds) ++found.below;
  });
  if (spine.count > 0) found.spine_behind = spine.y / spine.count - soft.y / soft.count;
  return found;
}

}  // namespace

std::string probableFlip(const Volume& volume, const Levels& levels) {
  const Found found = look(volume, levels);
  const bool front = found.spine_behind<-kClearOff, down = found.below> kClearRatio * found.above;
  if (!front && !down) return "";
  std::string axes = axesOf(volume);
  for (char& letter : axes)
    if ((front && (letter == 'A' || letter == 'P')) || (down && (letter == 'S' || letter == 'I')))
      letter = turned(letter);
  return std::string("The body seems to lie otherwise than the header says (") +
         (front ? "the spine is in front" : "") + (front && down ? ", " : "") +
         (down ? "the shoulders are below" : "") +
         "): look at the previews, and if so add --ct-axes " + axes +
         (front != down ? " --ct-mirrored" : "");
}

}  // namespace palpa::anatomy

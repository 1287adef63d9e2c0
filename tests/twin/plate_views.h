#pragma once

#include <vector>

#include "ar/boards/tag_detector.h"
#include "tests/twin_camera/bench_views.h"

/// Boards, lenses and places for tests of the virtual camera's free plates.
namespace palpa::twin {

using calibration::CameraModel;
using Ground = VirtualScene::Ground;

inline const ar::TagGridSpec kTable{}, kSmall{3, 2, 0.015, 0.004, 100},
    kSingle{1, 1, 0.03, 0.006, 200}, kHandheld{5, 4, 0.03, 0.0075, 300};
inline const VirtualCameraSettings kClean{0, 0, 0, 1};
inline const Pose kNowhere = Pose::Identity();  // before a wall the table's pose means nothing

inline CameraModel strongLens() {
  CameraModel strong = benchLens();
  strong.distortion = {-0.35, 0.14, 0.002, -0.0015, -0.02};
  return strong;
}

inline CameraModel pinhole() {
  CameraModel lens = benchLens();
  lens.distortion = {};
  return lens;
}

inline double draw(std::uint64_t i, std::uint64_t n, double low, double high) {
  return low + (high - low) * picture::uniform(31, 32 * i + n);
}

/// A sheet that faces the camera, tilted up to `tilt` about any axis, turned in any way.
inline Pose facing(std::uint64_t i, const Vec3& p_C, double tilt) {
  const double side = draw(i, 0, 0, 2 * std::numbers::pi);
  const Mat3 tilted =
      Eigen::AngleAxisd(draw(i, 1, 0, tilt), Vec3(std::cos(side), std::sin(side), 0))
          .toRotationMatrix();
  const Mat3 turned =
      Eigen::AngleAxisd(draw(i, 2, 0, 2 * std::numbers::pi), Vec3::UnitZ()).toRotationMatrix();
  return makePose(tilted * turned * Mat3(Vec3(1, -1, -1).asDiagonal()), p_C);
}

inline Pose turnedOver(const Pose& X) {
  return X * makePose(Vec3(1, -1, -1).asDiagonal(), Vec3::Zero());
}

inline const ar::TagDetector& detector() {
  static const ar::TagDetector one({1, 1, 10});
  return one;
}

}  // namespace palpa::twin

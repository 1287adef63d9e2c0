#pragma once

#include <algorithm>
#include <numbers>
#include <vector>

#include "apps/twin/virtual_camera.h"
#include "apps/twin/virtual_camera_noise.h"

/// Where the bench's camera stands in these tests.
namespace palpa::twin {

inline calibration::CameraModel benchLens() {
  return {640, 480, 600, 601, 322.3, 237.6, {-0.21, 0.09, 0.0006, -0.0004, -0.02}, 0};
}

inline double rad(double degrees) { return degrees * std::numbers::pi / 180; }

/// Looking at `target` on the board from `distance`, `tilt` away from straight above, from the side
/// `azimuth` (0: the reader's), turned by `roll` about the line of sight.
inline Pose lookAt(const Vec3& target, double distance, double tilt, double azimuth, double roll) {
  const Mat3 down = Vec3(1, -1, -1).asDiagonal();
  const Mat3 R_WC =
      (Eigen::AngleAxisd(azimuth, Vec3::UnitZ()) * Eigen::AngleAxisd(tilt, Vec3::UnitX()) *
       Eigen::AngleAxisd(roll, Vec3::UnitZ()))
          .toRotationMatrix() *
      down;
  return makePose(R_WC, target - distance * R_WC.col(2)).inverse();
}

/// View `i` of a seeded series: tilt 30 to 45 degrees, any side, target within 10 mm of the centre.
inline Pose benchView(std::uint64_t i, double distance) {
  const auto draw = [&](std::uint64_t n) { return picture::uniform(99, 16 * i + n); };
  return lookAt({0.02 * draw(0) - 0.01, 0.02 * draw(1) - 0.01, 0}, distance, rad(30 + 15 * draw(2)),
                rad(360 * draw(3)), rad(30 * draw(4) - 15));
}

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

}  // namespace palpa::twin

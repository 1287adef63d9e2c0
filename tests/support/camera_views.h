#pragma once

#include <numbers>

#include "calibration/camera_model.h"

/// A webcam, and where it stands, for tests that look at the board.
namespace palpa::test {

inline calibration::CameraModel webcam() {
  return {640, 480, 600, 601, 322.3, 237.6, {-0.21, 0.09, 0.0006, -0.0004, -0.02}, 0};
}

inline double rad(double degrees) { return degrees * std::numbers::pi / 180; }

/// X_CW: looking at `target_W` on the board from `distance`, `tilt` away from straight above, from
/// the side `azimuth` (0: the reader's), turned by `roll` about the line of sight.
inline Pose lookAt(const Vec3& target_W, double distance, double tilt, double azimuth,
                   double roll) {
  const Mat3 down = Vec3(1, -1, -1).asDiagonal();
  const Mat3 R_WC =
      (Eigen::AngleAxisd(azimuth, Vec3::UnitZ()) * Eigen::AngleAxisd(tilt, Vec3::UnitX()) *
       Eigen::AngleAxisd(roll, Vec3::UnitZ()))
          .toRotationMatrix() *
      down;
  return makePose(R_WC, target_W - distance * R_WC.col(2)).inverse();
}

}  // namespace palpa::test

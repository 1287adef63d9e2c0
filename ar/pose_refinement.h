#pragma once

#include <Eigen/Core>
#include <vector>

#include "ar/board.h"
#include "calibration/camera_model.h"

namespace palpa::ar {

struct RefinedPose {
  Pose X_CW;
  Eigen::Matrix<double, 6, 6> information;  ///< J^T J by (w, v), pixels squared per rad and m
  double rms_px = 0;
  int iterations = 0;
};

/// Levenberg-Marquardt over the reprojection error (Hartley & Zisserman 2004, A6.2):
///   min sum |pixel_i - project(X_CW p_i)|^2,   X_CW <- (exp([w]) R, t + v)
/// The damping scales the diagonal of J^T J. Stops when a step is below 1e-12 or after 50 steps.
RefinedPose refinePose(const Pose& start, const std::vector<BoardPoint>& points,
                       const calibration::CameraModel& camera);

}  // namespace palpa::ar

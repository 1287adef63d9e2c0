#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "ar/boards/board.h"
#include "calibration/camera_model.h"

namespace palpa::ar {

struct RefinedPose {
  Pose X_CW;
  Eigen::Matrix<double, 6, 6> information;  ///< J^T J by (w, v), pixels squared per rad and m
  double rms_px = 0;
  int iterations = 0;
};

/// A point of the board in the picture, and its derivative by the pose, px per rad and m.
struct SeenPoint {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 6> by_pose;
};
SeenPoint seenPoint(const Pose& X_CW, const Vec3& p_W, const calibration::CameraModel& camera);

/// Levenberg-Marquardt over the reprojection error (Hartley & Zisserman 2004, A6.2):
///   min sum |pixel_i - project(X_CW p_i)|^2,   X_CW <- (exp([w]) R, t + v)
/// The damping scales the diagonal of J^T J. Stops when a step is below 1e-12 or after 50 steps.
RefinedPose refinePose(const Pose& start, const std::vector<BoardPoint>& points,
                       const calibration::CameraModel& camera);

/// Never a bare pose: what it rests on and how sure it is.
struct BoardPose {
  Pose X_CW = Pose::Identity();
  Eigen::Matrix<double, 6, 6> covariance;  ///< of (rotation vector, translation) in C, rad and m
  double rms_px = 0;  ///< reprojection error: root of the mean squared distance
  /// of the second solution of the planar pose; infinite when there is none. Of one that fits far
  /// worse (twice the error and more) an upper bound
  double rms_other_px = 0;
  int points = 0;    ///< used
  int rejected = 0;  ///< left out because they fit no plane with the others
};

/// Pose from coplanar points (z_W = 0): both solutions of the planar problem (IPPE, Collins &
/// Bartoli 2014), each refined over the reprojection error by Levenberg-Marquardt, the better one
/// kept. Points that miss the plane common to the others by more than 5 px are left out first.
///
/// The perturbation is exp([w]) R, t + v: covariance = pixel_sigma^2 (J^T J)^-1 for (w, v), where
/// `pixel_sigma` is the standard deviation of one pixel coordinate.
///
/// Empty when fewer than four points or points on a line are given, or when no solution lies in
/// front of the camera with its printed side (+z) toward it. Throws Error when a point is not on
/// z_W = 0.
std::optional<BoardPose> estimateBoardPose(const std::vector<BoardPoint>& points,
                                           const calibration::CameraModel& camera,
                                           double pixel_sigma = 0.2);

/// The same, and after it the second solution where there is one: small or distant boards fit
/// nearly as well tilted the other way.
std::vector<BoardPose> estimateBoardPoses(const std::vector<BoardPoint>& points,
                                          const calibration::CameraModel& camera,
                                          double pixel_sigma = 0.2);

}  // namespace palpa::ar

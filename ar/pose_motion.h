#pragma once

#include <Eigen/Core>

#include "anatomy/geometry/pose.h"

namespace palpa::ar {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix18 = Eigen::Matrix<double, 18, 18>;

/// What takes b to a: (w, v) with a = (exp([w]) R_b, p_b + v), as BoardPose has its covariance.
Vector6 difference(const Pose& a, const Pose& b);
/// And applied.
Pose stepped(const Pose& X, const Vector6& step);

/// A pose in motion: (turning rate, speed) and their derivatives, all in the frame that the pose is
/// in; rad, m, s. `covariance`: of (pose, rate, acceleration), six of each, the pose's as
/// `difference` has it.
struct PoseMotion {
  Pose X = Pose::Identity();
  Vector6 rate = Vector6::Zero(), acceleration = Vector6::Zero();
  Matrix18 covariance = Matrix18::Zero();
};

/// What moves a pose. `still`: it stands, but for a slow random walk of `walk` per square root of a
/// second. Otherwise Singer's model (1970) of a hand that steers: an acceleration of standard
/// deviation `acceleration` that dies away with `memory` while new ones come.
struct MotionModel {
  bool still = false;
  double walk_rad = 0, walk_m = 0;
  double acceleration_rad = 0, acceleration_m = 0;  ///< rad/s^2, m/s^2
  double memory = 0.3;                              ///< s
};

/// `dt` later (s, not negative).
PoseMotion predicted(const PoseMotion& motion, const MotionModel& model, double dt);

/// Joined with a measured pose (Kalman). `log_likelihood` of the measurement, but for a constant;
/// may be null.
PoseMotion updated(const PoseMotion& motion, const Pose& X_measured, const Matrix6& covariance,
                   double* log_likelihood = nullptr);

/// Squared Mahalanobis distance of a measured pose from where it is expected: chi-squared of six
/// degrees of freedom if it belongs there.
double surprise(const PoseMotion& motion, const Pose& X_measured, const Matrix6& covariance);

}  // namespace palpa::ar

#pragma once

#include <vector>

#include "anatomy/geometry/pose.h"
#include "calibration/robust_fit.h"

namespace palpa::calibration {

/// Where the tip of a tool is on the device's end effector E: pivot calibration. The tip rests in a
/// hole while the tool is tilted every way; X_DE are the poses of E in the device's base D, metres.
/// For every i
///   R_i tip_E + p_i = pivot_D.
/// Start: the least squares of these linear equations (Yaniv 2015, "algebraic one step"); then a
/// robust fit in which the residuals along the lever and across it have spreads of their own, for
/// an error of the orientation acts across only.
struct TipCalibration {
  Vec3 tip_E = Vec3::Zero(), pivot_D = Vec3::Zero();
  Mat3 covariance = Mat3::Zero();  ///< of tip_E, m^2
  Vec3 half95 = Vec3::Zero();      ///< of the 95 % intervals of tip_E's coordinates, m
  double rms = 0;                  ///< of the good samples' distances from the pivot, m
  double least_spread = 0;         ///< rms tilt about the axis tilted about least, rad
  Fit fit;
};

/// What a recording must hold to tell a tip.
struct TipLimits {
  int least_samples = 20;
  double least_spread = 0.08;  ///< rad: about 5 degrees rms about every axis but the tool's own
  double largest_sd = 0.001;   ///< m, of the tip in its worst direction
  double largest_rms = 0.005;  ///< m: else the tip has not stayed in its hole
  /// M: no tool on a hand-held device is longer. Inverse poses pivot as well, about another point
  double longest = 0.30;
};

/// Throws Error, in plain words, for too few samples, motion about one axis only, a tip that
/// wandered, and invalid figures.
TipCalibration calibrateTip(const std::vector<Pose>& X_DE, const TipLimits& limits = {});

/// Which way the needle points on E: it is spun about itself in a hole or a drill guide. For every
/// i
///   R_i axis_E = direction_D.
/// `toward_E`: which of the two ways along the axis is meant, roughly.
struct AxisCalibration {
  Vec3 axis_E = Vec3::UnitZ(), direction_D = Vec3::UnitZ();  ///< unit
  /// rad^2, across the axis: along across_E's columns
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 3, 2> across_E = Eigen::Matrix<double, 3, 2>::Zero();
  double rms = 0;     ///< rad
  double turned = 0;  ///< rad, the arc that was spun
  Fit fit;
};

/// Throws Error for too few samples (20), an arc below 60 degrees, and a spin about an axis that
/// wandered by more than 3 degrees rms.
AxisCalibration calibrateAxis(const std::vector<Pose>& X_DE, const Vec3& toward_E);

}  // namespace palpa::calibration

#pragma once

#include <vector>

#include "anatomy/geometry/pose.h"
#include "calibration/robust_fit.h"

namespace palpa::calibration {

/// A tag on the end effector, seen by a camera that stands still: poses of the end effector E in
/// the device's base D, and of the tag M in the camera C, taken together.
struct HandEyeSample {
  Pose X_DE = Pose::Identity(), X_CM = Pose::Identity();
};

/// X_DE X_EM = X_DC X_CM for every sample (A X = Z B; Shiu & Ahmad 1989, Zhuang 1994). For a camera
/// on the end effector that sees a tag which stands still give X_CM inverted: X_EM is then the
/// camera on the end effector, X_DC the tag in the base (A X = X B). Starts: closed forms over all
/// samples and over subsets of them (Kronecker product, Shah 2013; relative motions, Park & Martin
/// 1994), of which the one with the least median error is taken: a few gross errors cannot spoil
/// all. Then a robust fit of
///   log(R_CM' R^_CM)  and  t^_CM - t_CM,   X^_CM = X_DC^-1 X_DE X_EM,
/// with spreads of their own for the turn, for the shift across the camera's view and for the one
/// along it.
struct HandEye {
  Pose X_EM = Pose::Identity(), X_DC = Pose::Identity();
  Eigen::Matrix<double, 12, 12> covariance =
      Eigen::Matrix<double, 12, 12>::Zero();  ///< turn and shift of X_EM, then of X_DC
  double rms_turn = 0, rms_shift = 0;         ///< of the good samples, rad and m
  double left_out_turn = 0,
         left_out_shift = 0;  ///< rms of samples that the fit had not seen (five parts), rad and m
  Fit fit;

  /// Covariance of where the camera's point p_C lies in D, m^2.
  Mat3 covarianceAt(const Vec3& p_C) const;
};

/// Throws Error for fewer than 8 samples, a hand that stood still or turned about one axis only,
/// samples that do not fit each other (and says so where one of the lists seems to hold the inverse
/// poses), and figures that are none.
HandEye calibrateHandEye(const std::vector<HandEyeSample>& samples);

}  // namespace palpa::calibration

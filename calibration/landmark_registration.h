#pragma once

#include <vector>

#include "anatomy/geometry/pose.h"
#include "calibration/robust_fit.h"

namespace palpa::calibration {

/// One landmark: known in A (the phantom, the board), touched in B (the device's base); metres.
/// `sd`: of the touch, per coordinate, relative to the others'.
struct TouchedLandmark {
  Vec3 p_A = Vec3::Zero(), p_B = Vec3::Zero();
  double sd = 1e-3;
};

/// Absolute orientation: the pose of A in B with least sum over i of |X_BA p_A,i - p_B,i|^2 /
/// sd_i^2. Start: closed form by the singular value decomposition of the cross-covariance (Arun
/// 1987, Umeyama 1991); then robust.
struct LandmarkRegistration {
  Pose X_BA = Pose::Identity();
  Eigen::Matrix<double, 6, 6> covariance =
      Eigen::Matrix<double, 6, 6>::Zero();  ///< of (turn in A, shift in B), rad and m
  double fre = 0;    ///< fiducial registration error: rms of the good landmarks, m
  double scale = 1;  ///< that would fit best: far from 1 says that a unit or a landmark is wrong
  Fit fit;

  /// Predicted rms error at a point of A, m: sqrt(trace(J covariance J')), J = [-R [p]x, I].
  double tre(const Vec3& p_A) const;
  /// Covariance there, in B, m^2.
  Mat3 covarianceAt(const Vec3& p_A) const;
};

/// Throws Error for fewer than 4 landmarks, landmarks in one place, on one line or in one plane
/// (three tell a rigid motion, but not that a list is mirrored), landmarks whose distances differ
/// as units or mirrored coordinates do, and landmarks that fit badly (`largest_fre`, m) or of which
/// more than `most_outliers` (a share) do not fit the others.
LandmarkRegistration registerLandmarks(const std::vector<TouchedLandmark>& landmarks,
                                       double largest_fre = 0.005, double most_outliers = 0.3);

}  // namespace palpa::calibration

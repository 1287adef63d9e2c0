#pragma once

#include <string>
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
  /// of (turn in A, shift in B), rad and m
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
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

/// A point of a grid that was touched: where it is on the grid (frame G), where the device said its
/// tip was (D); metres. `lever_D`: the tip less the end effector, for it is the end effector's
/// place that a device has wrong; zero: the map is of the tip's own places.
struct TouchedPoint {
  Vec3 p_G = Vec3::Zero(), p_D = Vec3::Zero(), lever_D = Vec3::Zero();
};

/// The device's systematic position error as a smooth map (after Harders et al. 2009: rigid +
/// distortion): where the device says p_D the tip is at
///   corrected(p_D) = p_D + sum over k of c_k phi_k(q),   q = (p_D - centre_D) / half_D,
/// phi: the monomials of q up to `order`, of which the grid's pose takes the part that is a rigid
/// motion.
struct WorkspaceMap {
  int order = 0;  ///< 0: the device is right as it is
  Vec3 centre_D = Vec3::Zero(), half_D = Vec3::Ones();
  MatrixX coefficients;          ///< m, monomials by 3
  Pose X_GD = Pose::Identity();  ///< of the corrected device
  double rms_before = 0,
         rms_after = 0;  ///< m, of the points against the grid, rigid only and corrected
  double left_out_before = 0, left_out_after = 0;  ///< rms of points that the fit had not seen, m
  Fit fit;

  Vec3 corrected(const Vec3& p_D) const { return p_D + correction(p_D); }
  Vec3 correction(const Vec3& p_D) const;
  /// Covariance of the corrected point against the grid, m^2; grows outside what was touched.
  Mat3 covarianceAt(const Vec3& p_D) const;
};

/// The order (0 to 3) with the least error at points left out is taken, a higher one only if it is
/// better by a twentieth. Throws Error for fewer than 12 points, points in one plane (nothing is
/// known beside it), points that are in other units, and points that do not fit.
WorkspaceMap mapWorkspace(const std::vector<TouchedPoint>& points);

/// The same with a given order.
WorkspaceMap mapWorkspace(const std::vector<TouchedPoint>& points, int order);

}  // namespace palpa::calibration

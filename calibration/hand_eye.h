#pragma once

#include <vector>

#include "anatomy/geometry/pose.h"
#include "calibration/camera_model.h"
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
  /// turn and shift of X_EM, then of X_DC
  Eigen::Matrix<double, 12, 12> covariance = Eigen::Matrix<double, 12, 12>::Zero();
  double rms_turn = 0, rms_shift = 0;  ///< of the good samples, rad and m
  double left_out_turn = 0,
         left_out_shift = 0;  ///< rms of samples that the fit had not seen (five parts), rad and m
  Fit fit;

  /// Covariance of where the camera's point p_C lies in D, m^2.
  Mat3 covarianceAt(const Vec3& p_C) const;
};

/// Throws Error for fewer than 8 samples, a hand that stood still or turned about one axis only,
/// samples that do not fit each other (and says so where one of the lists seems to hold the inverse
/// poses), and invalid figures.
HandEye calibrateHandEye(const std::vector<HandEyeSample>& samples);

/// One pose of the tool as the camera saw it: the tag's corners (frame M, m) and their pixels, and
/// where the board W was in the same picture.
struct TagView {
  Pose X_DE = Pose::Identity(), X_CW = Pose::Identity();
  std::vector<Vec3> p_M;
  std::vector<Eigen::Vector2d> pixels;
};

/// The same unknowns as in HandEye with the board in the camera's place (X_DC is then X_DW), moved
/// to the least reprojection error
///   sum over poses and corners of |pixel - project(X_CW X_DW^-1 X_DE X_EM p_M)|^2,
/// robust by whole poses: what the picture measures well (across the view) counts for more than
/// what it does not (along it). The covariance is that of clustered errors (Liang & Zeger 1986):
/// the corners of a pose share its errors, and 16 of them do not tell 16 times as much.
struct RefinedHandEye {
  Pose X_EM = Pose::Identity(), X_DW = Pose::Identity();
  /// turn and shift of X_EM, then of X_DW
  Eigen::Matrix<double, 12, 12> covariance = Eigen::Matrix<double, 12, 12>::Zero();
  double rms_px = 0;             ///< of the good poses' corners
  double left_out_px = 0;        ///< rms of corners in poses that the fit had not seen (five parts)
  double left_out_start_px = 0;  ///< the same by the start, fitted to the same others' poses
  Fit fit;
};

/// Only views with as many corners as most are used. Throws Error for fewer than 8 of them, and as
/// calibrateHandEye does.
RefinedHandEye refineHandEye(const std::vector<TagView>& views,
                             const std::vector<HandEyeSample>& poses, const CameraModel& camera);

}  // namespace palpa::calibration

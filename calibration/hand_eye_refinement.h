#pragma once

#include <vector>

#include "calibration/camera_model.h"
#include "calibration/hand_eye.h"

namespace palpa::calibration {

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
  Eigen::Matrix<double, 12, 12> covariance =
      Eigen::Matrix<double, 12, 12>::Zero();  ///< turn and shift of X_EM, then of X_DW
  double rms_px = 0;                          ///< of the good poses' corners
  double left_out_px = 0;        ///< rms of corners in poses that the fit had not seen (five parts)
  double left_out_start_px = 0;  ///< the same by the start, fitted to the same others' poses
  Fit fit;
};

/// Only views with as many corners as most are used. Throws Error for fewer than 8 of them, and as
/// calibrateHandEye does.
RefinedHandEye refineHandEye(const std::vector<TagView>& views,
                             const std::vector<HandEyeSample>& poses, const CameraModel& camera);

}  // namespace palpa::calibration

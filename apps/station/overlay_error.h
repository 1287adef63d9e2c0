#pragma once

#include <optional>

#include "apps/station/station_file.h"
#include "ar/tracking/board_pose.h"

/// How far off the overlay is expected to be at the needle's tip: root mean squares, by the
/// covariances of the station's calibrations. Nothing for a station without calibrated tool and
/// registration.
namespace palpa::station {

/// Covariance (m^2) of where the tip is thought to be in W against where it is, at a pose of the
/// end effector:
///   S_W = J_reg S_reg J_reg' + R_WE S_tip R_WE'
std::optional<Mat3> predictTipCovariance(const Station& station, const Pose& X_DE);

struct OverlayError {
  double mm = 0;  ///< sqrt(trace S_W)
  double px = 0;  ///< where the tip is drawn in the picture against where it is seen
};

/// The same, and with a pose of the board in the camera:
///   S_px = J_p R_CW S_W R_CW' J_p' + J_b S_b J_b' + J_c S_c J_c',   px = sqrt(trace S_px)
/// S_b: of the board's pose; J_c: how the pixel of the tip moves with the lens when the board's
/// pose, found with that lens, moves along. Without a camera calibration the lens counts as exact.
std::optional<OverlayError> predictOverlayError(const Station& station, const Pose& X_DE,
                                                const ar::BoardPose& board);

}  // namespace palpa::station

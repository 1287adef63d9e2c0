#pragma once

#include <functional>
#include <optional>

#include "apps/doctor/finding.h"
#include "apps/runtime/clock.h"
#include "ar/boards/board.h"
#include "ar/cameras/camera.h"
#include "calibration/camera_model.h"

namespace palpa::doctor {

/// What a camera's pictures were like for a while.
struct PictureFacts {
  int pictures = 0, wrong_size = 0, alike = 0;  ///< alike: bit for bit as the one before
  double seconds = 0;                           ///< from the first to the last exposure
  /// Means over the pictures: the brightest hundredth, 0 to 255; share of pixels at 250 or more
  double bright = 0, burnt = 0;
  /// Width of the sharpest edges (10 % to 90 % of the contrast) on the board: median of the
  /// pictures that show it
  double edge_px = 0;
  int seen = 0;         ///< pictures in which the board was found
  double rms_px = 0;    ///< of the board's points against its pose, median
  int backward = 0;     ///< pictures that were not exposed after the one before
  int undated = 0;      ///< pictures of a real camera whose time is not of this computer's clock
  std::string remark;   ///< what the camera does not let be fixed, in words
  std::string trouble;  ///< the source failed: its words
};

/// Looks at `count` pictures. `grab` gives the next, nothing when there are no more; what it throws
/// is told in the facts. `clock`: a real camera's pictures should be dated by it; null: they are
/// recorded or simulated.
PictureFacts lookAt(const std::function<std::optional<ar::Frame>()>& grab, int count,
                    const ar::Board& board, const calibration::CameraModel& camera,
                    const runtime::Clock* clock = nullptr);

/// "camera" (pictures come, exposure, focus) and "board" (seen, fits). `rate_Hz`: what the station
/// asks for.
Findings judgePictures(const PictureFacts& facts, double rate_Hz,
                       const calibration::CameraModel& camera);

}  // namespace palpa::doctor

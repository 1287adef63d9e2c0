#pragma once

#include <opencv2/core.hpp>

#include "calibration/camera_model.h"

namespace palpa::ar {

/// Pictures without lens distortion, and the pinhole that took them: what a renderer, which knows
/// straight lines only, can be laid over. The maps are computed once, from CameraModel itself.
class Undistorter {
 public:
  /// The pinhole is the widest one of the same size whose picture has no empty border; pixels are
  /// square (fx = fy) whatever the camera's are.
  explicit Undistorter(const calibration::CameraModel& camera);

  /// Throws Error when the picture has another size than the camera.
  cv::Mat apply(const cv::Mat& image) const;

  /// Same size, no distortion.
  const calibration::CameraModel& pinhole() const { return pinhole_; }

 private:
  calibration::CameraModel pinhole_;
  cv::Mat coarse_, fine_;  ///< whole pixels, and 1/32 px steps between them
};

}  // namespace palpa::ar

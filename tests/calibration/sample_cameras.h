#pragma once

#include <vector>

#include "calibration/camera_model.h"

namespace palpa::calibration {

/// No distortion; a webcam with barrel distortion; one of 2.8 mm with a strong barrel; a pincushion
/// with thick tangential terms and pixels that are not square.
inline std::vector<CameraModel> sampleCameras() {
  return {{640, 480, 600, 600, 319.5, 239.5, {}, 0},
          {640,
           480,
           536.07,
           536.02,
           342.37,
           235.54,
           {-0.26509, -0.04674, 0.00183, -0.00031, 0.25231},
           0.3},
          {1280, 720, 780, 780, 655, 350, {-0.31, 0.12, 0.0004, -0.0003, -0.022}, 0.2},
          {1920, 1080, 1700, 1680, 940, 560, {0.12, 0.08, -0.003, 0.002, 0.05}, 0.5}};
}

}  // namespace palpa::calibration

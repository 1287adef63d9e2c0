#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ar/cameras/camera.h"

namespace palpa::ar {

/// How a camera of the computer is to be set. What is not given is left as it is, but what changes
/// by itself is fixed: exposure, focus and white balance that the camera adjusts would move the
/// picture under a calibration.
struct WebcamSettings {
  std::string device = "/dev/video0";
  int width = 640, height = 480;
  double rate_Hz = 30;
  double exposure_ms = 10;
  double gain = -1, focus = -1;  ///< the driver's units; negative: as it is
  bool adjusts = false;  ///< itself, to light and distance, at any size: nothing is measured in it
};

/// A camera behind Video4Linux, through OpenCV. Frames carry the driver's stamp of their transfer
/// (CLOCK_MONOTONIC, ns; 0 where it gives none); a station's camera latency says how long before
/// that their exposure was.
class Webcam : public Camera {
 public:
  /// Throws Error where there is no such camera, it is in use, or it does not give pictures of that
  /// size.
  explicit Webcam(const WebcamSettings& settings);
  ~Webcam() override;
  /// Waits for the next picture. Throws Error when the camera has gone.
  std::optional<Frame> grab() override;
  /// What the driver did not accept, in words.
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  std::vector<std::string> remarks_;
};

}  // namespace palpa::ar

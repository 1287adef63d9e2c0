#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "ar/board.h"
#include "calibration/camera_model.h"

namespace palpa::twin {

/// What a real camera adds to a perfect picture.
struct VirtualCameraSettings {
  double blur_sigma_px = 0.6;   ///< lens and pixel, Gaussian
  double noise_sigma = 3;       ///< gray levels, at every brightness
  std::int64_t latency_ns = 0;  ///< from the middle of the exposure to delivery; the bench waits it
  double exposure = 1;          ///< relative brightness; white paper saturates from about 1.15 on
};

/// Honest pictures of the tag board on a table, as the station's camera would take them: 8-bit
/// gray, lens distortion exactly as CameraModel's, uneven light, blur, noise.
///
/// Each pixel's ray is found once (CameraModel::unproject). A frame is a homography from rays to
/// the plane z_W = 0 and a look-up in one of a series of area-averaged textures, a factor sqrt(2)
/// apart, the one whose texels are nearest to a pixel's footprint at the board's centre: no edge is
/// aliased, and none is shifted, because every filter in the chain is symmetric.
///
/// A pure function of (seed, frame number, pose); the noise comes from a counter-based stream.
class VirtualCamera {
 public:
  /// Throws Error or UsageError when camera, board or settings are not possible.
  VirtualCamera(const calibration::CameraModel& truth, const ar::TagGridSpec& board,
                const VirtualCameraSettings& settings, std::uint64_t seed);

  /// `X_CW_true`: pose of the board in the camera. A camera below the table sees nothing but its
  /// tone.
  cv::Mat render(const Pose& X_CW_true, std::uint64_t frame_number) const;

  const calibration::CameraModel& truth() const { return truth_; }
  const VirtualCameraSettings& settings() const { return settings_; }

 private:
  struct Texture {
    cv::Mat gray;
    double texel = 0;  ///< metres; the texture's centre is W's origin, +y is up
  };

  const Texture& textureFor(const Pose& X_CW) const;
  cv::Mat lookUp(const Pose& X_CW) const;
  void expose(std::uint64_t frame_number, cv::Mat* picture) const;

  calibration::CameraModel truth_;
  VirtualCameraSettings settings_;
  std::uint64_t seed_;
  cv::Mat ray_x_, ray_y_;            ///< at unit depth, for every pixel
  cv::Mat gain_;                     ///< light and exposure, 256 = 1
  std::vector<Texture> textures_;    ///< fine to coarse
  std::vector<std::int16_t> noise_;  ///< 1/16 gray levels
};

}  // namespace palpa::twin

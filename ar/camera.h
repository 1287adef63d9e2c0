#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace palpa::ar {

/// A picture with the time of its exposure. `image` is 8-bit, 1 (gray) or 3 (BGR) channels.
struct Frame {
  std::uint64_t number = 0;
  std::int64_t t_exposure_ns = 0;
  cv::Mat image;
  std::string source;  ///< file name or device, for reports
};

/// Anything that yields pictures: recorded images, a webcam, the virtual bench.
class Camera {
 public:
  virtual ~Camera() = default;
  /// The next picture, or nothing when the source has ended. Throws Error when it fails.
  virtual std::optional<Frame> grab() = 0;
};

}  // namespace palpa::ar

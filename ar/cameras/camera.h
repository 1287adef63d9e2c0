#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <opencv2/core.hpp>

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

/// What can be wrong with a picture or with where it comes from.
enum class PictureFault { none, black, frozen, wrong_size, gone, ended };

/// Judges picture after picture of one camera. black: the brightest hundredth is darker than
/// `kBlack`. frozen: bit for bit the same as the ones before for half a second and five pictures; a
/// sensor's noise never is. Samples every 7th pixel.
class PictureHealth {
 public:
  explicit PictureHealth(cv::Size expected) : expected_(expected) {}
  PictureFault judge(const cv::Mat& image, std::int64_t t_ns);

 private:
  cv::Size expected_;
  std::uint64_t fingerprint_ = 0;
  std::int64_t since_ns_ = 0;  ///< first of the same pictures
  int same_ = 0;
};

}  // namespace palpa::ar

#include "ar/cameras/camera.h"

#include <array>

namespace palpa::ar {
namespace {

constexpr int kBlack = 12;  // gray levels
constexpr std::size_t kStep = 7;
constexpr std::int64_t kFrozenFor_ns = 500'000'000;
constexpr int kFrozenPictures = 5;

struct PixelStatistics {
  std::uint64_t fingerprint = 0xcbf29ce484222325ull;  // FNV-1a
  std::array<std::size_t, 256> histogram{};
  std::size_t count = 0;
};

PixelStatistics samplesOf(const cv::Mat& image) {
  PixelStatistics s;
  const std::size_t bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
  for (int row = 0; row < image.rows; ++row) {
    const unsigned char* line = image.ptr<unsigned char>(row);
    for (std::size_t i = static_cast<std::size_t>(row) % kStep; i < bytes; i += kStep) {
      s.fingerprint = (s.fingerprint ^ line[i]) * 0x100000001b3ull;
      ++s.histogram[line[i]];
      ++s.count;
    }
  }
  return s;
}

bool isBlack(const PixelStatistics& s) {
  std::size_t bright = 0;
  for (std::size_t level = kBlack; level < s.histogram.size(); ++level)
    bright += s.histogram[level];
  return bright * 100 < s.count;
}

}  // namespace

PictureFault PictureHealth::judge(const cv::Mat& image, std::int64_t t_ns) {
  if (image.empty() || image.size() != expected_) return PictureFault::wrong_size;
  const PixelStatistics samples = samplesOf(image);
  if (same_ == 0 || samples.fingerprint != fingerprint_) {
    fingerprint_ = samples.fingerprint;
    since_ns_ = t_ns;
    same_ = 0;
  }
  ++same_;
  if (isBlack(samples)) return PictureFault::black;
  return same_ >= kFrozenPictures && t_ns - since_ns_ >= kFrozenFor_ns ? PictureFault::frozen
                                                                       : PictureFault::none;
}

}  // namespace palpa::ar

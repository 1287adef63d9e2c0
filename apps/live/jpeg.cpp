#include "apps/live/jpeg.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "ar/codecs/codecs.h"

namespace palpa::live {

std::string jpegOf(const scene::Image& image, int quality, int widest) {
  const cv::Mat shown(image.height, image.width, CV_8UC3,
                      const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat bgr;
  cv::cvtColor(shown, bgr, cv::COLOR_RGB2BGR);
  if (widest > 0 && bgr.cols > widest)
    cv::resize(bgr, bgr, {widest, bgr.rows * widest / bgr.cols}, 0, 0, cv::INTER_AREA);
  const std::vector<std::uint8_t> bytes =
      ar::encode(".jpg", bgr, {cv::IMWRITE_JPEG_QUALITY, quality});
  return {bytes.begin(), bytes.end()};
}

}  // namespace palpa::live

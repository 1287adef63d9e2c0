#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace cv {
class VideoCapture;
class VideoWriter;
}  // namespace cv

namespace palpa::ar {

/// What the loaded library offers: one table, under this name, both sides compiled together.
struct LoadedCodecs {
  bool (*encode)(const std::string& ending, cv::InputArray picture, std::vector<std::uint8_t>& to,
                 const std::vector<int>& parameters);
  cv::Mat (*decode)(cv::InputArray bytes, int flags);
  cv::VideoCapture* (*newCapture)();
  cv::VideoWriter* (*newWriter)();
};
inline constexpr char kLoadedCodecs[] = "palpa_loaded_codecs";

}  // namespace palpa::ar

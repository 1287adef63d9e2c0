#include "apps/replay/recorded_pictures.h"

#include <algorithm>
#include <charconv>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

namespace palpa::replay {
namespace {

constexpr unsigned char kEscape = 0xff, kBegin = 0xd8;  // JPEG's start of image; a byte 0xff in the
                                                        // data is followed by 0 (ITU T.81, B.1.1.5)

/// Second field of every line after the first.
std::vector<std::int64_t> timesIn(const std::filesystem::path& table) {
  std::vector<std::int64_t> times;
  std::ifstream lines(table);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    const std::size_t comma = line.find(',');
    std::int64_t t = 0;
    if (comma == std::string::npos ||
        std::from_chars(line.data() + comma + 1, line.data() + line.size(), t).ec != std::errc())
      break;
    times.push_back(t);
  }
  return times;
}

}  // namespace

RecordedPictures::RecordedPictures(const std::filesystem::path& folder)
    : film_(folder / "camera.mjpeg", std::ios::binary) {
  if (!film_) return;
  findPictures();
  times_ns_ = timesIn(folder / "camera.mjpeg.csv");
  times_ns_.resize(std::min(times_ns_.size(), begins_.size() - 1));
}

void RecordedPictures::findPictures() {
  std::vector<char> block(1 << 16);
  std::streamoff at = 0;
  unsigned char before = 0;
  while (film_.read(block.data(), static_cast<std::streamsize>(block.size())), film_.gcount() > 0) {
    for (std::streamsize i = 0; i < film_.gcount(); ++i) {
      const auto byte = static_cast<unsigned char>(block[static_cast<std::size_t>(i)]);
      if (before == kEscape && byte == kBegin) begins_.push_back(at + i - 1);
      before = byte;
    }
    at += film_.gcount();
  }
  begins_.push_back(at);
  film_.clear();
}

void RecordedPictures::read(std::size_t number) {
  shown_ = number;
  std::vector<char> jpeg(static_cast<std::size_t>(begins_[number + 1] - begins_[number]));
  film_.seekg(begins_[number]);
  film_.read(jpeg.data(), static_cast<std::streamsize>(jpeg.size()));
  film_.clear();
  const cv::Mat picture = cv::imdecode(jpeg, cv::IMREAD_COLOR);
  if (picture.empty()) return;
  cv::Mat rgb;
  cv::cvtColor(picture, rgb, cv::COLOR_BGR2RGB);
  image_ = {rgb.cols, rgb.rows, 3, {}};
  image_.pixels.assign(rgb.data, rgb.data + rgb.total() * 3);
}

const scene::Image* RecordedPictures::at(std::int64_t t_ns) {
  const auto after = std::upper_bound(times_ns_.begin(), times_ns_.end(), t_ns);
  if (after == times_ns_.begin()) return nullptr;
  const auto number = static_cast<std::size_t>(after - times_ns_.begin()) - 1;
  if (number != shown_) read(number);
  return image_.pixels.empty() ? nullptr : &image_;
}

}  // namespace palpa::replay

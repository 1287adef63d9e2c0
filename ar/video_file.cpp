#include "ar/video_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "anatomy/geometry/error.h"

namespace palpa::ar {
namespace {

constexpr double kUsualRate = 30;

/// Second column of the table beside a film: ns. Empty where there is none.
std::vector<std::int64_t> timesBeside(const std::filesystem::path& film) {
  std::vector<std::int64_t> times;
  std::ifstream table(film.string() + ".csv");
  std::string line;
  std::getline(table, line);  // header
  while (std::getline(table, line)) {
    long long number = 0, t = 0;
    if (std::sscanf(line.c_str(), "%lld,%lld", &number, &t) != 2 ||
        (!times.empty() && t <= times.back()))
      break;
    times.push_back(t);
  }
  return times;
}

}  // namespace

struct VideoFile::Impl {
  explicit Impl(const std::filesystem::path& file)
      : path(file), film(file.string(), cv::CAP_FFMPEG), times(timesBeside(file)) {}
  std::filesystem::path path;
  cv::VideoCapture film;
  std::vector<std::int64_t> times;
  double rate = kUsualRate;
  std::uint64_t next = 0;
};

VideoFile::VideoFile(const std::filesystem::path& file) try : impl_(std::make_unique<Impl>(file)) {
  if (!std::filesystem::is_regular_file(file))
    throw Error("there is no such film", file.string(), "Check the name");
  if (!impl_->film.isOpened())
    throw Error("cannot be read as a film", file.string(), "Convert it to MP4 or to Motion JPEG");
  const double rate = impl_->film.get(cv::CAP_PROP_FPS);
  if (std::isfinite(rate) && rate >= 1 && rate <= 1000) impl_->rate = rate;
} catch (const cv::Exception&) {
  throw Error("cannot be read as a film", file.string(), "Convert it to MP4 or to Motion JPEG");
}

VideoFile::~VideoFile() = default;

double VideoFile::rate_Hz() const {
  const std::vector<std::int64_t>& times = impl_->times;
  return times.size() < 2 ? impl_->rate
                          : 1e9 * static_cast<double>(times.size() - 1) /
                                static_cast<double>(times.back() - times.front());
}

std::optional<Frame> VideoFile::grab() {
  Frame frame;
  if (!impl_->film.read(frame.image) || frame.image.empty()) {
    if (impl_->next == 0)
      throw Error("holds no picture that can be read", impl_->path.string(),
                  "Convert it to MP4 or to Motion JPEG");
    return std::nullopt;
  }
  frame.number = impl_->next++;
  const bool timed = frame.number < impl_->times.size();
  frame.t_exposure_ns = timed ? impl_->times[frame.number]
                              : std::llround(1e9 * static_cast<double>(frame.number) / impl_->rate);
  frame.source = impl_->path.string();
  return frame;
}

bool isVideoFile(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* known : {".mp4", ".m4v", ".mov", ".mkv", ".avi", ".webm", ".mjpeg", ".mjpg"})
    if (ending == known) return true;
  return false;
}

}  // namespace palpa::ar

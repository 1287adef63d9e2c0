#include "apps/replay/film.h"

#include <cerrno>

#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/child_process.h"
#include "apps/os/file_access.h"

namespace palpa::replay {
namespace {

/// A name that nobody has, of the same ending, by which the writer knows the kind.
std::filesystem::path besideOf(const std::filesystem::path& file) {
  constexpr int kTries = 100;
  for (int tries = 1; tries <= kTries; ++tries) {
    std::filesystem::path beside =
        file.parent_path() /
        ("." + file.stem().string() + ".part-" + std::to_string(os::processNumber()) + "-" +
         std::to_string(tries) + file.extension().string());
    const std::error_code problem = os::createNew(beside);
    if (!problem) return beside;
    if (problem != std::errc::file_exists) failFile("cannot be written", file, problem);
  }
  failFile("cannot be written", file, EEXIST);
}

int countedFrames(const std::filesystem::path& file) {
  const std::unique_ptr<cv::VideoCapture> again = ar::makeVideoCapture();
  int frames = 0;
  again->open(file.string());
  while (again->isOpened() && again->grab()) ++frames;
  return frames;
}

}  // namespace

int codecOf(const std::filesystem::path& file) {
  if (file.extension() == ".avi") return ar::fourcc("MJPG");
  if (file.extension() == ".mp4") return ar::fourcc("mp4v");
  throw UsageError("is not a kind of video that can be written", file.string(),
                   "End its name in .mp4 or .avi");
}

Film::Film(const std::filesystem::path& file, double frames_per_second, int width, int height)
    : file_(file),
      beside_(besideOf(file)),
      writer_(ar::makeVideoWriter()),
      width_(width),
      height_(height) {
  if (writer_->open(beside_.string(), codecOf(file), frames_per_second, {width, height})) return;
  std::error_code ignored;
  std::filesystem::remove(beside_, ignored);
  throw Error("cannot be written", file.string(),
              "Choose another place or --size, or try the ending .avi");
}

Film::~Film() {
  writer_->release();
  std::error_code ignored;
  if (!finished_) std::filesystem::remove(beside_, ignored);
}

void Film::add(const scene::Image& picture) {
  if (picture.width != width_ || picture.height != height_)
    throw Error("a picture has another size than the film", file_.string(),
                "Choose an even --size that fits the screen");
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                    const_cast<std::uint8_t*>(picture.pixels.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  writer_->write(bgr);
  ++frames_;
}

void Film::finish() {
  writer_->release();
  if (const int there = countedFrames(beside_); there != frames_)
    throw Error("only " + std::to_string(there) + " of " + std::to_string(frames_) +
                    " pictures can be read again",
                file_.string(), "Is the disk full?");
  std::error_code problem;
  std::filesystem::rename(beside_, file_, problem);
  if (problem) failFile("cannot be written", file_, problem);
  finished_ = true;
}

}  // namespace palpa::replay

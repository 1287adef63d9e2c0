#include "ar/cameras/recorded_pictures.h"

#include <glob.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/film_table.h"
#include "anatomy/base/whole_file.h"
#include "ar/codecs/codecs.h"

namespace palpa::ar {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> matching(const std::string& pattern) {
  std::vector<fs::path> files;
  glob_t found{};
  if (::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found) == 0)
    for (std::size_t i = 0; i < found.gl_pathc; ++i)
      if (fs::is_regular_file(found.gl_pathv[i])) files.emplace_back(found.gl_pathv[i]);
  ::globfree(&found);
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return a.native() < b.native(); });
  return files;
}

/// A copy that broke off: decoders fill the rest with grey, or complain on standard error.
bool isCutShort(const std::string& bytes) {
  const auto last = [&](const char* marker) {
    return static_cast<std::ptrdiff_t>(bytes.rfind(marker));
  };
  if (bytes.starts_with("\xff\xd8"))
    return last("\xff\xd9") <= last("\xff\xda");  // end, after the scan
  if (bytes.starts_with("\x89PNG")) return bytes.rfind("IEND") == std::string::npos;
  return false;
}

cv::Mat load(const fs::path& file) {
  if (!fs::is_regular_file(file))
    throw Error("the picture was there when the sequence was opened, and is gone", file.string(),
                "Put it back, or open the sequence again.");
  const std::string bytes = readWhole(file).value_or("");
  if (isCutShort(bytes))
    throw Error("is cut short", file.string(), "Copy the picture again, or narrow the pattern.");
  cv::Mat image;
  try {
    image =
        decode({bytes.begin(), bytes.end()}, cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {  // an absurd header: treated like any damage
  }
  if (image.empty())
    throw Error("cannot be read as a picture", file.string(),
                "Replace the file (PNG and JPEG work), or narrow the pattern.");
  return image;
}

std::string text(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

ImageSequence::ImageSequence(const std::string& glob, double fps)
    : files_(matching(glob)), fps_(fps) {
  if (!(std::isfinite(fps) && fps > 0))
    throw UsageError("pictures a second must be positive", "image sequence", "Give e.g. 15.");
  if (files_.empty())
    throw Error("no picture matches", glob,
                "Give a pattern of files, in quotes, such as 'pictures/left*.jpg'.");
}

std::optional<Frame> ImageSequence::grab() {
  if (next_ == files_.size()) return std::nullopt;
  const fs::path& file = files_[next_];
  Frame frame;
  frame.image = load(file);
  if (next_ == 0) size_ = frame.image.size();
  if (frame.image.size() != size_)
    throw Error("is " + text(frame.image.size()) + ", the pictures before it are " + text(size_),
                file.string(), "Keep pictures of one camera and one size in a sequence.");
  frame.number = next_;
  frame.t_exposure_ns = std::llround(double(next_) / fps_ * 1e9);
  frame.source = file.string();
  ++next_;
  return frame;
}

namespace {

constexpr double kUsualRate = 30;

/// As far as time goes on in it.
std::vector<FilmPicture> timesOf(const std::filesystem::path& film) {
  std::vector<FilmPicture> table = filmTable(film);
  const auto back =
      std::adjacent_find(table.begin(), table.end(),
                         [](const auto& one, const auto& next) { return next.t_ns <= one.t_ns; });
  if (back != table.end()) table.erase(back + 1, table.end());
  return table;
}

}  // namespace

struct VideoFile::Impl {
  explicit Impl(const std::filesystem::path& file)
      : path(file), film(makeVideoCapture()), table(timesOf(file)) {
    film->open(file.string(), cv::CAP_FFMPEG);
  }
  std::filesystem::path path;
  std::unique_ptr<cv::VideoCapture> film;
  std::vector<FilmPicture> table;
  double rate = kUsualRate;
  std::uint64_t next = 0;
};

VideoFile::VideoFile(const std::filesystem::path& file) try : impl_(std::make_unique<Impl>(file)) {
  if (!std::filesystem::is_regular_file(file))
    throw Error("there is no such film", file.string(), "Check the name");
  if (!impl_->film->isOpened())
    throw Error("cannot be read as a film", file.string(), "Convert it to MP4 or to Motion JPEG");
  const double rate = impl_->film->get(cv::CAP_PROP_FPS);
  if (std::isfinite(rate) && rate >= 1 && rate <= 1000) impl_->rate = rate;
} catch (const cv::Exception&) {
  throw Error("cannot be read as a film", file.string(), "Convert it to MP4 or to Motion JPEG");
}

VideoFile::~VideoFile() = default;

double VideoFile::rate_Hz() const {
  const std::vector<FilmPicture>& table = impl_->table;
  return table.size() < 2 ? impl_->rate
                          : 1e9 * static_cast<double>(table.size() - 1) /
                                static_cast<double>(table.back().t_ns - table.front().t_ns);
}

std::optional<Frame> VideoFile::grab() {
  Frame frame;
  if (!impl_->film->read(frame.image) || frame.image.empty()) {
    if (impl_->next == 0)
      throw Error("holds no picture that can be read", impl_->path.string(),
                  "Convert it to MP4 or to Motion JPEG");
    return std::nullopt;
  }
  frame.number = impl_->next++;
  const bool timed = frame.number < impl_->table.size();
  frame.t_exposure_ns = timed ? impl_->table[frame.number].t_ns
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

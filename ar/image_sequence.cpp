#include "ar/image_sequence.h"

#include <glob.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "anatomy/geometry/error.h"

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
    throw Error("the picture has gone since the sequence was opened", file.string(),
                "Put it back, or open the sequence again.");
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (isCutShort(bytes))
    throw Error("is cut short", file.string(), "Copy the picture again, or narrow the pattern.");
  cv::Mat image;
  try {
    image = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()),
                         cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION);
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

}  // namespace palpa::ar

#include "apps/calibrate/watched_picture.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "ar/codecs/codecs.h"

namespace palpa::cli {
namespace {

constexpr std::int64_t kApart_ns = 200'000'000;
constexpr int kEnough = 20;  // points in a part of the picture that make it wholly tinted
const cv::Scalar kTint{178, 114, 0}, kRing{0, 159, 230};  // blue, orange of Okabe and Ito; BGR

void tint(cv::Mat& picture, const calibration::CoverageMap& coverage) {
  const int rows = static_cast<int>(calibration::kCoverageRows),
            columns = static_cast<int>(calibration::kCoverageColumns);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int seen = coverage[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
      if (seen == 0) continue;
      const cv::Rect cell(
          cv::Point(column * picture.cols / columns, row * picture.rows / rows),
          cv::Point((column + 1) * picture.cols / columns, (row + 1) * picture.rows / rows));
      const double share = 0.12 + 0.23 * std::min(1.0, static_cast<double>(seen) / kEnough);
      cv::Mat part = picture(cell);
      cv::addWeighted(part, 1 - share, cv::Mat(part.size(), part.type(), kTint), share, 0, part);
    }
  }
}

}  // namespace

void WatchedPicture::see(const ar::Frame& frame) {
  if (frame.image.empty() || clock_.now() < next_ns_) return;
  next_ns_ = clock_.now() + kApart_ns;
  if (frame.image.channels() == 1)
    cv::cvtColor(frame.image, last_, cv::COLOR_GRAY2BGR);
  else
    last_ = frame.image.clone();
  points_.clear();
  write();
}

void WatchedPicture::covered(const std::vector<ar::BoardPoint>& points,
                             const calibration::CoverageMap& coverage) {
  points_ = points;
  coverage_ = coverage;
  if (!last_.empty()) write();
}

void WatchedPicture::write() const {
  cv::Mat shown = last_.clone();
  tint(shown, coverage_);
  for (const ar::BoardPoint& point : points_)
    cv::circle(shown, cv::Point(cvRound(point.pixel.x()), cvRound(point.pixel.y())), 4, kRing, 2,
               cv::LINE_AA);
  const std::vector<std::uint8_t> bytes = ar::encode(".jpg", shown, {cv::IMWRITE_JPEG_QUALITY, 85});
  try {
    writeWhole(file_, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, Lasts::no);
  } catch (const Error&) {
  }
}

}  // namespace palpa::cli

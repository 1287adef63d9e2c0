#include "ar/board_tracker.h"

#include <algorithm>

namespace palpa::ar {
namespace {

// The detector thresholds in tiles of 4 x 4 pixels of the decimated picture: on a grid of 8 the
// part is judged like the whole.
constexpr int kTile = 8;
constexpr double kMargin = 0.25;  // of the board's width and height, for its white edge and motion
constexpr int kMargin_px = 16;

cv::Rect around(const std::vector<BoardPoint>& points, const cv::Size& size) {
  if (points.empty()) return {};
  Eigen::AlignedBox2d box;
  for (const BoardPoint& point : points) box.extend(point.pixel);
  const Eigen::Vector2d margin = kMargin * box.sizes() + Eigen::Vector2d::Constant(kMargin_px);
  const auto down = [](double x) { return int(x) / kTile * kTile; };
  const int left = down(std::max(box.min().x() - margin.x(), 0.0));
  const int top = down(std::max(box.min().y() - margin.y(), 0.0));
  const int right = std::min(down(box.max().x() + margin.x()) + kTile, size.width);
  const int bottom = std::min(down(box.max().y() + margin.y()) + kTile, size.height);
  return {left, top, right - left, bottom - top};
}

}  // namespace

BoardTracker::BoardTracker(const Board& board, const calibration::CameraModel& camera)
    : board_(board), camera_(camera) {}

std::vector<BoardPoint> BoardTracker::detect(const cv::Mat& image) {
  if (!region_.empty() && (region_ & cv::Rect({}, image.size())) == region_) {
    std::vector<BoardPoint> points = board_.detect(image(region_));
    for (BoardPoint& point : points) point.pixel += Eigen::Vector2d(region_.x, region_.y);
    if (points.size() >= seen_) return points;
  }
  return board_.detect(image);
}

std::optional<BoardPose> BoardTracker::see(const cv::Mat& image) {
  const std::vector<BoardPoint> points = detect(image);
  region_ = around(points, image.size());
  seen_ = points.size();
  return estimateBoardPose(points, camera_);
}

}  // namespace palpa::ar

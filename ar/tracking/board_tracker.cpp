#include "ar/tracking/board_tracker.h"

#include <algorithm>
#include <cmath>

namespace palpa::ar {
namespace {

// The detector thresholds in tiles of 4 x 4 pixels of the decimated picture: on a grid of 8 the
// part is judged like the whole.
constexpr int kTile = 8;
constexpr double kMargin = 0.12;  // of the board's width and height in the picture: its white edge
constexpr double kMargin_px = 12, kSpreads = 4;
// [chosen] of real boards: 0.1 to 0.4 px, blurred and bent ones to 1; what is no board fits by tens
constexpr double kWorstFit_px = 2.5;
constexpr double kSeparate =
    16;  // chi-squared by which one planar solution must fit better than the other
constexpr double kSigmaAtFirst_px = 0.2, kLeastSigma_px = 0.03, kLearns = 0.05;

cv::Rect onTiles(const Eigen::AlignedBox2d& box, const cv::Size& size) {
  const auto down = [](double x, int most) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(most))) / kTile * kTile;
  };
  const int left = down(box.min().x(), size.width), top = down(box.min().y(), size.height);
  const int right = std::min(down(box.max().x(), size.width) + kTile, size.width),
            bottom = std::min(down(box.max().y(), size.height) + kTile, size.height);
  return {left, top, right - left, bottom - top};
}

/// How much better the first solution fits, in units of chi-squared.
double separation(const BoardPose& pose, double sigma_px) {
  return pose.points * (pose.rms_other_px * pose.rms_other_px - pose.rms_px * pose.rms_px) /
         (sigma_px * sigma_px);
}

}  // namespace

BoardTracker::BoardTracker(const Board& board, const calibration::CameraModel& camera,
                           const Settings& settings)
    : board_(board),
      camera_(camera),
      settings_(settings),
      track_(settings.track),
      sigma_px_(kSigmaAtFirst_px) {}

cv::Rect BoardTracker::expected(const cv::Size& size, std::int64_t t_ns) const {
  const PoseLookup there = track_.at(t_ns);
  if (there.how == Lookup::none || extent_.isEmpty()) return {};
  Eigen::AlignedBox2d box;
  double spread_px = 0;
  for (const auto corner : {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                            Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight}) {
    const Eigen::Vector2d on_board = extent_.corner(corner);
    const Vec3 p_C = there.X * Vec3(on_board.x(), on_board.y(), 0);
    if (!(p_C.z() > 0.01)) return {};
    box.extend(camera_.project(p_C));
    const double turned = there.covariance.topLeftCorner<3, 3>().trace() * on_board.squaredNorm(),
                 shifted = there.covariance.bottomRightCorner<3, 3>().trace();
    spread_px = std::max(spread_px, camera_.fx / p_C.z() * std::sqrt(turned + shifted));
  }
  if (!box.min().allFinite() || !box.max().allFinite()) return {};
  const Eigen::Vector2d margin =
      kMargin * box.sizes() + Eigen::Vector2d::Constant(kMargin_px + kSpreads * spread_px);
  const cv::Rect region = onTiles({box.min() - margin, box.max() + margin}, size);
  return region.area() * 4 < size.area() * 3
             ? region
             : cv::Rect();  // hardly smaller than the whole: not worth a second look
}

Matrix6 BoardTracker::scaled(const BoardPose& pose) const {
  return std::pow(sigma_px_ / kSigmaAtFirst_px, 2) * pose.covariance;
}

std::optional<BoardPose> BoardTracker::believable(const std::vector<BoardPoint>& points,
                                                  std::int64_t t_ns) const {
  std::vector<BoardPose> poses = estimateBoardPoses(points, camera_, kSigmaAtFirst_px);
  std::erase_if(poses, [](const BoardPose& pose) {
    return !(pose.rms_px <= kWorstFit_px) || !pose.covariance.allFinite();
  });
  if (poses.empty()) return std::nullopt;
  const PoseFilter& filter = track_.filter();
  const bool alike = poses.size() > 1 && separation(poses.front(), sigma_px_) < kSeparate;
  const PoseLookup there = track_.at(t_ns);
  if (there.how != Lookup::none) {
    if (alike && difference(poses[1].X_CW, there.X).head<3>().norm() <
                     difference(poses[0].X_CW, there.X).head<3>().norm())
      std::swap(poses[0], poses[1]);
    if (!filter.isForeign(poses.front().X_CW, scaled(poses.front()), t_ns)) return poses.front();
  }
  if (alike || poses.front().points < board_.leastPoints()) return std::nullopt;
  return poses.front();
}

void BoardTracker::learn(const std::vector<BoardPoint>& points, const BoardPose& pose) {
  for (const BoardPoint& point : points) extent_.extend(point.p_W.head<2>());
  const int free = 2 * pose.points - 6;
  if (free < 6) return;
  const double seen = pose.rms_px * pose.rms_px * pose.points / free,
               weight = kLearns * std::min(1.0, free / 40.0);
  sigma_px_ =
      std::max(std::sqrt((1 - weight) * sigma_px_ * sigma_px_ + weight * seen), kLeastSigma_px);
}

std::optional<BoardPose> BoardTracker::see(const cv::Mat& image, std::int64_t t_ns) {
  return see([&image](const cv::Rect&) { return image; }, image.size(), t_ns);
}

std::optional<BoardPose> BoardTracker::see(const Picture& picture, const cv::Size& size,
                                           std::int64_t t_ns) {
  if (!settings_.motion) track_.forget();
  region_ = expected(size, t_ns);
  std::vector<BoardPoint> points;
  std::optional<BoardPose> pose;
  if (!region_.empty()) {
    points = board_.detect(picture(region_)(region_));
    for (BoardPoint& point : points) point.pixel += Eigen::Vector2d(region_.x, region_.y);
    pose = believable(points, t_ns);
  }
  if (!pose) {
    points = board_.detect(picture({}));
    pose = believable(points, t_ns);
  }
  return conclude(points, std::move(pose), t_ns);
}

std::optional<BoardPose> BoardTracker::take(const std::vector<BoardPoint>& points,
                                            std::int64_t t_ns) {
  if (!settings_.motion) track_.forget();
  region_ = {};
  return conclude(points, believable(points, t_ns), t_ns);
}

/// What a picture means for the track.
std::optional<BoardPose> BoardTracker::conclude(const std::vector<BoardPoint>& points,
                                                std::optional<BoardPose> pose, std::int64_t t_ns) {
  if (pose && !track_.add(pose->X_CW, scaled(*pose), t_ns)) pose.reset();
  if (pose) learn(points, *pose);
  const bool predicted = track_.at(t_ns).how != Lookup::none;
  state_ = pose                              ? TrackState::tracked
           : predicted                       ? TrackState::coasting
           : state_ == TrackState::searching ? TrackState::searching
                                             : TrackState::lost;
  return pose;
}

}  // namespace palpa::ar

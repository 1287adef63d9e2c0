#include "ar/boards/april_grid.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "ar/boards/gray_picture.h"

namespace palpa::ar {
namespace {

std::array<Vec3, 4> turned(const std::array<Vec3, 4>& corners, int quarters) {
  std::array<Vec3, 4> result;
  for (std::size_t i = 0; i < 4; ++i) result[i] = corners[(i + std::size_t(quarters)) % 4];
  return result;
}

/// From W's plane to the picture.
cv::Matx33d planeToPicture(const Tag& tag, const std::array<Vec3, 4>& corners) {
  cv::Point2f plane[4], picture[4];
  for (std::size_t i = 0; i < 4; ++i) {
    plane[i] = cv::Point2f(cv::Point2d(corners[i].x(), corners[i].y()));
    picture[i] = cv::Point2f(cv::Point2d(tag.corners[i].x(), tag.corners[i].y()));
  }
  return cv::getPerspectiveTransform(plane, picture);
}

Eigen::Vector2d middle(const Tag& tag) {
  return (tag.corners[0] + tag.corners[1] + tag.corners[2] + tag.corners[3]) / 4;
}

bool predicts(const cv::Matx33d& H, const Tag& tag, const Tag& other, const Vec3& other_W) {
  const cv::Vec3d p = H * cv::Vec3d(other_W.x(), other_W.y(), 1);
  if (!(p[2] > 0)) return false;  // beyond the horizon
  const Eigen::Vector2d predicted(p[0] / p[2], p[1] / p[2]), seen = middle(other);
  return (predicted - seen).norm() < 0.5 * (seen - middle(tag)).norm();
}

/// For each tag, how many of the others it agrees with, both ways, after `quarters` turns.
std::vector<int> agreements(const std::vector<Tag>& tags, const TagGridSpec& spec, int quarters) {
  std::vector<cv::Matx33d> H;
  std::vector<Vec3> middle_W;
  for (const Tag& tag : tags) {
    const std::array<Vec3, 4> corners = tagCorners(spec, tag.id);
    H.push_back(planeToPicture(tag, turned(corners, quarters)));
    middle_W.push_back((corners[0] + corners[2]) / 2);
  }
  std::vector<int> count(tags.size(), 0);
  for (std::size_t i = 0; i < tags.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (predicts(H[i], tags[i], tags[j], middle_W[j]) &&
          predicts(H[j], tags[j], tags[i], middle_W[i])) {
        ++count[i];
        ++count[j];
      }
  return count;
}

}  // namespace

std::vector<PlacedTag> placeTags(const std::vector<Tag>& tags, const TagGridSpec& spec) {
  int turn = 0, most = 0;
  std::vector<int> best(tags.size(), 0);
  for (int quarters = 0; quarters < 4; ++quarters) {
    const std::vector<int> count = agreements(tags, spec, quarters);
    int sum = 0;
    for (const int n : count) sum += n;
    if (sum <= most) continue;
    most = sum;
    turn = quarters;
    best = count;
  }
  std::vector<PlacedTag> placed;
  for (std::size_t i = 0; i < tags.size(); ++i)
    if (best[i] > 0 && 2 * best[i] >= int(tags.size()) - 1)
      placed.push_back({tags[i], turned(tagCorners(spec, tags[i].id), turn)});
  if (placed.size() < 2) placed.clear();
  return placed;
}

namespace {

constexpr int kSmallestLevel = 640;  // pixels along the longer side of a halved picture

/// Width of the narrower of border and gap, as a share of the tag: what lies beside a corner.
/// Across a gap stands the next crossing, which a turned window must not reach with its corner
/// either.
double band(const TagGridSpec& spec) {
  return std::min(spec.border_bits / (6.0 + 2 * spec.border_bits),
                  std::sqrt(0.5) * spec.spacing / spec.tag_size);
}

/// One pixel less of black, off its upper and left edges: enough to part what touches at a point.
std::vector<Tag> detectShrunk(const TagDetector& detector, const cv::Mat& gray) {
  cv::Mat shrunk;
  cv::dilate(gray, shrunk, cv::Mat::ones(2, 2, CV_8U), {1, 1});
  std::vector<Tag> tags = detector.detect(shrunk);
  for (Tag& tag : tags)
    for (Eigen::Vector2d& corner : tag.corners) corner -= Eigen::Vector2d(0.5, 0.5);
  return tags;
}

/// Blur joins black that touches, most of all in steep views.
cv::Mat sharpened(const cv::Mat& gray) {
  cv::Mat blurred, sharp;
  cv::GaussianBlur(gray, blurred, {0, 0}, 2);
  cv::addWeighted(gray, 2.5, blurred, -1.5, 0, sharp);
  return sharp;
}

/// Tags of the picture and of its halves, in pixels of the picture.
std::vector<Tag> detectLevels(const TagDetector& detector, const cv::Mat& gray) {
  std::vector<Tag> all;
  cv::Mat level = gray;
  for (double scale = 1;; scale *= 2) {
    for (const cv::Mat& picture : {level, sharpened(level)})
      for (Tag& tag : detectShrunk(detector, picture)) {
        for (Eigen::Vector2d& c : tag.corners)
          c = scale * c + Eigen::Vector2d::Constant((scale - 1) / 2);
        all.push_back(tag);
      }
    if (std::max(level.cols, level.rows) / 2 < kSmallestLevel) return all;
    cv::Mat half;
    cv::resize(level, half, {level.cols / 2, level.rows / 2}, 0, 0, cv::INTER_AREA);
    level = half;
  }
}

std::vector<cv::Point2f> outline(const Tag& tag) {
  std::vector<cv::Point2f> points;
  for (const Eigen::Vector2d& c : tag.corners) points.emplace_back(cv::Point2d(c.x(), c.y()));
  return points;
}

/// Each of our ids once, from the finest level that shows it; none of an id at two places.
std::vector<Tag> ours(const std::vector<Tag>& all, const TagGridSpec& spec) {
  std::vector<Tag> tags;
  for (int id = spec.first_id; id < spec.first_id + spec.columns * spec.rows; ++id) {
    const Tag* first = nullptr;
    bool twice = false;
    for (const Tag& tag : all) {
      if (tag.id != id) continue;
      if (first)
        twice |= (tag.corners[0] - first->corners[0]).norm() > 0.5 * outlineHeight(outline(*first));
      else
        first = &tag;
    }
    if (first && !twice) tags.push_back(*first);
  }
  return tags;
}

/// From the tag, sides of 1 round (0, 0), its corners numbered as the library does, to the picture.
cv::Matx33d unitTagToPicture(const Tag& tag) {
  const cv::Point2f unit[4] = {{-0.5F, -0.5F}, {0.5F, -0.5F}, {0.5F, 0.5F}, {-0.5F, 0.5F}};
  return cv::getPerspectiveTransform(unit, outline(tag).data());
}

void appendCorners(const cv::Mat& gray, PlacedTag placed, double width,
                   std::vector<BoardPoint>* points) {
  const double room = width * outlineHeight(outline(placed.tag));
  std::array<bool, 4> good{};
  for (std::size_t i = 0; i < 4; ++i) good[i] = refineSaddle(gray, room, &placed.tag.corners[i]);
  const cv::Matx33d H = unitTagToPicture(placed.tag);
  for (std::size_t i = 0; i < 4; ++i) {
    const double sx = i == 1 || i == 2 ? 1 : -1, sy = i >= 2 ? 1 : -1;
    const Eigen::Vector2d corner(sx / 2, sy / 2), x(sx * width / 2, 0), y(0, sy * width / 2);
    if (good[i] && isCrossing(gray, placed.tag.corners[i], stepInPicture(H, corner, x),
                              stepInPicture(H, corner, y)))
      points->push_back({placed.corners_W[i], placed.tag.corners[i]});
  }
}

}  // namespace

AprilGridBoard::AprilGridBoard(const TagGridSpec& spec)
    : spec_(spec), detector_(boardTagSettings(1, spec.border_bits)) {
  validate(spec, "AprilGrid");
}

std::vector<BoardPoint> AprilGridBoard::detect(const cv::Mat& image) const {
  const cv::Mat gray = grayPicture(image);
  std::vector<BoardPoint> points;
  for (const PlacedTag& placed : placeTags(ours(detectLevels(detector_, gray), spec_), spec_))
    appendCorners(gray, placed, band(spec_), &points);
  return points;
}

std::string AprilGridBoard::describe() const {
  std::ostringstream text;
  text << "AprilGrid of " << spec_.columns << " x " << spec_.rows << " tag36h11 of "
       << spec_.tag_size * 1000 << " mm with a border of " << spec_.border_bits << " cells, "
       << spec_.spacing * 1000 << " mm apart, ids from " << spec_.first_id;
  return text.str();
}

}  // namespace palpa::ar

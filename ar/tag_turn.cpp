#include "ar/tag_turn.h"

#include <opencv2/imgproc.hpp>

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

bool foretells(const cv::Matx33d& H, const Tag& tag, const Tag& other, const Vec3& other_W) {
  const cv::Vec3d p = H * cv::Vec3d(other_W.x(), other_W.y(), 1);
  if (!(p[2] > 0)) return false;  // beyond the horizon
  const Eigen::Vector2d foretold(p[0] / p[2], p[1] / p[2]), seen = middle(other);
  return (foretold - seen).norm() < 0.5 * (seen - middle(tag)).norm();
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
      if (foretells(H[i], tags[i], tags[j], middle_W[j]) &&
          foretells(H[j], tags[j], tags[i], middle_W[i])) {
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

}  // namespace palpa::ar

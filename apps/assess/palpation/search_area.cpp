#include "apps/assess/palpation/search_area.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpa::assess {
namespace {

using Eigen::Vector2d;

/// Even and odd crossings of the line from `p` to the right.
bool within(const std::vector<Vector2d>& outline, const Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vector2d &a = outline[i], &b = outline[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    inside ^= p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y());
  }
  return inside;
}

Vector2d nearestOn(const std::vector<Vector2d>& outline, const Vector2d& p) {
  Vector2d nearest = outline.front();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vector2d along = outline[i] - outline[j];
    const double length2 = along.squaredNorm(),
                 part =
                     length2 > 0 ? std::clamp((p - outline[j]).dot(along) / length2, 0.0, 1.0) : 0;
    const Vector2d there = outline[j] + part * along;
    if ((there - p).norm() >= least) continue;
    least = (there - p).norm();
    nearest = there;
  }
  return nearest;
}

bool hasOutline(const SearchArea& area) { return area.outline.size() >= 3; }

}  // namespace

double insideBy(const SearchArea& area, const Vec3& p_P) {
  const double in_box = std::min(area.half_x - std::abs(p_P.x()), area.half_y - std::abs(p_P.y()));
  if (!hasOutline(area)) return in_box;
  const Vector2d p = p_P.head<2>();
  const double far = (nearestOn(area.outline, p) - p).norm();
  return within(area.outline, p) ? std::min(far, in_box) : -far;
}

Vec3 nearestIn(const SearchArea& area, const Vec3& p_P) {
  Vec3 in_box(std::clamp(p_P.x(), -area.half_x, area.half_x),
              std::clamp(p_P.y(), -area.half_y, area.half_y), p_P.z());
  if (!hasOutline(area) || within(area.outline, in_box.head<2>())) return in_box;
  const Vector2d edge = nearestOn(area.outline, in_box.head<2>());
  return {edge.x(), edge.y(), p_P.z()};
}

Vec3 onTop(const SearchArea& area, const Vec3& p_P) {
  return {p_P.x(), p_P.y(), heightOf(area.top, p_P.x(), p_P.y()).z};
}

Vector2d foreshortening(const SearchArea& area) {
  constexpr int kSteps = 24;
  Vector2d longest(1, 1);
  if (area.top.flat()) return longest;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      const Vec3 p(area.half_x * i / kSteps, area.half_y * j / kSteps, 0);
      if (insideBy(area, p) < 0) continue;
      const TopHeight h = heightOf(area.top, p.x(), p.y());
      longest = longest.cwiseMax(Vector2d(std::sqrt(1 + h.zx * h.zx), std::sqrt(1 + h.zy * h.zy)));
    }
  }
  return longest;
}

}  // namespace palpa::assess

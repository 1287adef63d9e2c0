#include <cmath>
#include <limits>

#include "anatomy/triangle_distance.h"
#include "anatomy/triangle_tree.h"

namespace palpa::anatomy {
namespace {

// Single precision rounds a box's distance from the segment by less than this part of the
// coordinates.
constexpr float kSlack = 1e-6f;

float limitAbove(double squared) { return static_cast<float>(squared * (1 + 1e-5)); }

}  // namespace

TriangleTree::SegmentDistance TriangleTree::nearSegment(const Vec3& a, const Vec3& b) const {
  const Eigen::Vector3f from = (a - centre_).cast<float>(), way = (b - a).cast<float>();
  const Eigen::Vector3f to = from + way, low = from.cwiseMin(to), high = from.cwiseMax(to);
  const float inverse = way.squaredNorm() > 0 ? 1 / way.squaredNorm() : 0;
  const float size = from.cwiseAbs().maxCoeff() + to.cwiseAbs().maxCoeff() +
                     static_cast<float>(bounds_.sizes().maxCoeff());
  // The larger of two lower bounds: from the segment's own box, and from the sphere about the
  // node's box.
  const auto bound = [&](const Node& node) {
    Lanes apart = Lanes::Zero(), along = Lanes::Zero(), radius = Lanes::Zero();
    Lanes middle[3];
    for (int axis = 0; axis < 3; ++axis) {
      apart += (node.low[axis] - high[axis])
                   .max(low[axis] - node.high[axis])
                   .max(Lanes::Zero())
                   .square();
      middle[axis] = 0.5f * (node.low[axis] + node.high[axis]) - from[axis];
      radius += (0.5f * (node.high[axis] - node.low[axis])).square();
      along += middle[axis] * way[axis];
    }
    const Lanes s = (along * inverse).max(Lanes::Zero()).min(Lanes::Ones());
    Lanes off = Lanes::Zero();
    for (int axis = 0; axis < 3; ++axis) off += (middle[axis] - s * way[axis]).square();
    const Lanes sphere = off.sqrt() - radius.sqrt();
    Lanes least = (apart.sqrt().max(sphere) - kSlack * size).max(Lanes::Zero()).square();
    for (int lane = 0; lane < 4; ++lane)  // a lane without a child
      if (!(node.low[0][lane] <= node.high[0][lane]))
        least[lane] = std::numeric_limits<float>::infinity();
    return least;
  };
  // No farther than its beginning: what is farther than that need not be looked at.
  const Nearest at_a = search(a);
  SegmentToTriangle best{at_a.squared, 0, at_a.weights};
  std::uint32_t nearest = at_a.triangle;
  const auto leaf = [&](std::uint32_t child, float) {
    for (std::uint32_t i = leafBegin(child); i < leafEnd(child); ++i) {
      const SegmentToTriangle found = segmentToTriangle(a, b, corners_[i]);
      if (found.squared >= best.squared) continue;
      best = found;
      nearest = i;
    }
    return limitAbove(best.squared);
  };
  descend(bound, leaf, limitAbove(best.squared));
  const auto& t = corners_[nearest];
  const Vec3 p = best.weights[0] * t[0] + best.weights[1] * t[1] + best.weights[2] * t[2];
  const Vec3 on = a + best.s * (b - a);
  const double distance = std::sqrt(best.squared);
  const bool inside =
      distance > 0 && pseudonormal({best.squared, nearest, best.weights, p}).dot(on - p) < 0;
  return {inside ? -distance : distance, best.s, p, interpolated(nearest, best.weights)};
}

}  // namespace palpa::anatomy

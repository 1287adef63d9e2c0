#include <algorithm>
#include <cmath>

#include "anatomy/triangle_tree.h"

namespace palpa::anatomy {
namespace {

// Slightly inclusive triangles, so that a ray through a shared edge cannot slip between both.
constexpr double kEdgeTolerance = 1e-9;

// Seen area below this part of the longest edge squared: nothing to hit.
constexpr double kFlatTriangle = 1e-11;

struct Ray {
  Vec3 start, direction, inverse;
  double length;
};

bool hitsBox(const Vec3& low, const Vec3& high, const Ray& ray) {
  double near = 0, far = ray.length;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (low[axis] - ray.start[axis]) * ray.inverse[axis];
    const double b = (high[axis] - ray.start[axis]) * ray.inverse[axis];
    if (std::isnan(a) || std::isnan(b)) continue;  // runs within the slab's face
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

struct Hit {
  double s = 0;
  Vec3 weights;
  bool entering = false;
};

/// Weights as volumes with the ray; the depth is interpolated from the corners, which stays right
/// for slivers, where a division by the normal would not.
bool hitsTriangle(const std::array<Vec3, 3>& t, const Ray& ray, Hit* hit) {
  const Vec3 a = t[0] - ray.start, b = t[1] - ray.start, c = t[2] - ray.start;
  const Vec3& d = ray.direction;
  Vec3 w(d.dot(b.cross(c)), d.dot(c.cross(a)), d.dot(a.cross(b)));
  const double sum = w.sum();  // direction . normal, twice the area seen along the ray
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  // Edge-on or without area: its neighbours, slightly inclusive, take the ray.
  if (std::abs(sum) < kFlatTriangle * longest * longest) return false;
  w /= sum;
  if (w.minCoeff() < -kEdgeTolerance) return false;
  const double s = w.dot(Vec3(a.dot(d), b.dot(d), c.dot(d)));
  *hit = {s, w, sum < 0};
  return s >= 0 && s <= ray.length;
}

}  // namespace

int TriangleTree::cast(const Vec3& start, const Vec3& direction, double length, Crossing* crossings,
                       int room, bool* lost) const {
  const Ray ray{start - centre_, direction, direction.cwiseInverse(), length};
  const Ray exact{start, direction, ray.inverse, length};
  const double same = 1e-9 * (1 + length);  // two crossings closer than this are one
  int count = 0;
  *lost = false;
  const auto bound = [&ray](const Node& node) {
    Lanes bounds;
    for (int lane = 0; lane < 4; ++lane) {
      const Vec3 low(node.low[0][lane], node.low[1][lane], node.low[2][lane]);
      const Vec3 high(node.high[0][lane], node.high[1][lane], node.high[2][lane]);
      bounds[lane] = hitsBox(low, high, ray) ? 0.0f : 1.0f;
    }
    return bounds;
  };
  const auto leaf = [&](std::uint32_t child, float limit) {
    for (std::uint32_t i = leafBegin(child); i < leafEnd(child); ++i) {
      Hit hit;
      if (!hitsTriangle(corners_[i], exact, &hit)) continue;
      const bool known = std::any_of(crossings, crossings + count, [&](const Crossing& other) {
        return other.entering == hit.entering && std::abs(other.s - hit.s) <= same;
      });
      if (known) continue;
      if (count == room) {
        *lost = true;
        continue;
      }
      Vec3 n = interpolated(i, hit.weights);
      if (n.dot(face_normals_[i]) <= 0) n = face_normals_[i];
      crossings[count++] = {hit.s, n, hit.entering};
    }
    return limit;
  };
  descend(bound, leaf, 0.5f);  // 0: the ray meets the box
  return count;
}

}  // namespace palpa::anatomy

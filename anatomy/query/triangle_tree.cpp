#include "anatomy/query/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anatomy/query/triangle_distance.h"
#include "anatomy/query/triangle_tree_build.h"

namespace palpa::anatomy {
namespace {

// Weights below this are on an edge or at a corner: 1e-12 of an edge is far under rounding of p.
constexpr double kOnFeature = 1e-12;

// Cosine between normals of one facet's corners from which on it is not rounded: 60 degrees.
constexpr double kSmooth = 0.5;

// Single precision rounds a box's distance by less than this part of it.
constexpr double kRounding = 2e-6;

float limitOf(double squared) { return static_cast<float>(squared * (1 + kRounding)); }

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh)
    : points_(mesh.points), normals_(mesh.normals), triangles_(mesh.triangles) {
  TriangleTreeBuilder build(*this);
  makePseudonormals();
}

Vec3 TriangleTree::interpolated(std::uint32_t triangle, const Vec3& weights) const {
  const Corners& t = triangles_[triangle];
  const Vec3 n =
      weights[0] * normals_[t[0]] + weights[1] * normals_[t[1]] + weights[2] * normals_[t[2]];
  const double length = n.norm();
  return length > 1e-9 ? Vec3(n / length) : face_normals_[triangle];
}

Vec3 TriangleTree::pseudonormal(const Nearest& nearest) const {
  const Vec3& w = nearest.weights;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    const bool next_zero = w[next] <= kOnFeature, last_zero = w[last] <= kOnFeature;
    if (next_zero && last_zero) return vertex_pseudonormals_[triangles_[nearest.triangle][k]];
    if (last_zero && w[k] > kOnFeature) return edge_pseudonormals_[nearest.triangle][k];
  }
  return face_normals_[nearest.triangle];
}

void TriangleTree::searchLeaf(std::uint32_t child, const Vec3& p, Nearest* best) const {
  for (std::uint32_t i = leafBegin(child); i < leafEnd(child); ++i) {
    const auto& t = corners_[i];
    const Vec3 w = closestWeights(p, t[0], t[1], t[2]);
    const Vec3 q = w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
    const double squared = (p - q).squaredNorm();
    if (squared < best->squared) *best = {squared, i, w, q};
  }
}

TriangleTree::Nearest TriangleTree::search(const Vec3& p) const {
  Nearest best{std::numeric_limits<double>::infinity()};
  const Eigen::Vector3f q = (p - centre_).cast<float>();
  const auto bound = [&q](const Node& node) { return node.squaredFrom(q); };
  const auto leaf = [&](std::uint32_t child, float) {
    searchLeaf(child, p, &best);
    return limitOf(best.squared);
  };
  descend(bound, leaf, std::numeric_limits<float>::infinity());
  return best;
}

TriangleTree::Closest TriangleTree::closest(const Vec3& p) const {
  const Nearest best = search(p);
  const double distance = std::sqrt(best.squared);
  const bool inside = pseudonormal(best).dot(p - best.p) < 0;
  return {best.p, interpolated(best.triangle, best.weights), inside ? -distance : distance,
          triangles_[best.triangle], best.weights};
}

TriangleTree::Closest TriangleTree::rounded(const Vec3& p) const {
  const Nearest best = search(p);
  const Corners& t = triangles_[best.triangle];
  const Vec3 normal = interpolated(best.triangle, best.weights);
  const std::array<Vec3, 3> n{normals_[t[0]], normals_[t[1]], normals_[t[2]]};
  Vec3 q = best.p;
  // Where the normals of the corners stand far apart there is an edge, and it stays one.
  if (std::min({n[0].dot(n[1]), n[1].dot(n[2]), n[2].dot(n[0])}) > kSmooth)
    q = roundedPoint(corners_[best.triangle], n, best.weights);
  return {q, normal, (p - q).dot(normal), t, best.weights};
}

Vec3 roundedPoint(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& n, const Vec3& w) {
  // Control point a third of the way from corner i to corner j, moved into i's tangent plane.
  const auto edge = [&](int i, int j) {
    return Vec3((2 * p[i] + p[j] - (p[j] - p[i]).dot(n[i]) * n[i]) / 3);
  };
  const Vec3 e01 = edge(0, 1), e10 = edge(1, 0), e12 = edge(1, 2), e21 = edge(2, 1),
             e20 = edge(2, 0), e02 = edge(0, 2);
  const Vec3 mean = (e01 + e10 + e12 + e21 + e20 + e02) / 6;
  const Vec3 centre = mean + (mean - (p[0] + p[1] + p[2]) / 3) / 2;
  const double a = w[0], b = w[1], c = w[2];
  return a * a * a * p[0] + b * b * b * p[1] + c * c * c * p[2] +
         3 * (a * a * b * e01 + a * b * b * e10 + b * b * c * e12 + b * c * c * e21 +
              c * c * a * e20 + c * a * a * e02) +
         6 * a * b * c * centre;
}

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

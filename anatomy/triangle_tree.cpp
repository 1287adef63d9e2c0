#include "anatomy/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace palpa::anatomy {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr int kMaxDepth = 64;  // median splits: 2^64 triangles

// Weights below this are on an edge or at a corner: 1e-12 of an edge is far under rounding of p.
constexpr double kOnFeature = 1e-12;

// Slightly inclusive triangles, so that a ray through a shared edge cannot slip between both.
constexpr double kEdgeTolerance = 1e-9;

// Cosine between normals of one facet's corners from which on it is not rounded: 60 degrees.
constexpr double kSmooth = 0.5;

// Seen area below this part of the longest edge squared: nothing to hit.
constexpr double kFlat = 1e-11;

bool hitsBox(const Eigen::AlignedBox3d& box, const Vec3& start, const Vec3& inverse,
             double length) {
  double near = 0, far = length;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min()[axis] - start[axis]) * inverse[axis];
    const double b = (box.max()[axis] - start[axis]) * inverse[axis];
    if (std::isnan(a) || std::isnan(b)) continue;  // runs within the slab's face
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

double cornerAngle(const Vec3& corner, const Vec3& p, const Vec3& q) {
  const Vec3 u = p - corner, v = q - corner;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh)
    : points_(mesh.points), normals_(mesh.normals), triangles_(mesh.triangles) {
  std::vector<Vec3> centres;
  centres.reserve(triangles_.size());
  for (const Corners& t : triangles_)
    centres.push_back((points_[t[0]] + points_[t[1]] + points_[t[2]]) / 3);
  nodes_.reserve(triangles_.size() + 1);
  split(0, static_cast<std::uint32_t>(triangles_.size()), &centres);
  makePseudonormals();
}

std::uint32_t TriangleTree::split(std::uint32_t first, std::uint32_t count,
                                  std::vector<Vec3>* centres) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  Eigen::AlignedBox3d centre_box;
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const std::uint32_t corner : triangles_[i]) node.box.extend(points_[corner]);
    centre_box.extend((*centres)[i]);
  }
  nodes_.push_back(node);
  if (count <= kLeafSize) {
    nodes_[index].first = first;
    nodes_[index].count = count;
    return index;
  }
  int axis = 0;
  centre_box.sizes().maxCoeff(&axis);
  // Sort indices, then move triangles and centres alike; ties broken by index: the same tree
  // always.
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = first + i;
  const std::uint32_t half = count / 2;
  std::nth_element(order.begin(), order.begin() + half, order.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = (*centres)[a][axis], y = (*centres)[b][axis];
                     return x < y || (x == y && a < b);
                   });
  std::vector<Corners> triangles(count);
  std::vector<Vec3> moved(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    triangles[i] = triangles_[order[i]];
    moved[i] = (*centres)[order[i]];
  }
  std::copy(triangles.begin(), triangles.end(), triangles_.begin() + first);
  std::copy(moved.begin(), moved.end(), centres->begin() + first);
  split(first, half, centres);
  const std::uint32_t right = split(first + half, count - half, centres);
  nodes_[index].right = right;
  return index;
}

void TriangleTree::makePseudonormals() {
  const std::size_t count = triangles_.size();
  face_normals_.resize(count);
  vertex_pseudonormals_.assign(points_.size(), Vec3::Zero());
  edge_pseudonormals_.resize(count);
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::map<Edge, Vec3> edges;
  const auto key = [](std::uint32_t a, std::uint32_t b) {
    return Edge(std::min(a, b), std::max(a, b));
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Corners& t = triangles_[i];
    const Vec3 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    const Vec3 n = face_normals_[i] = (b - a).cross(c - a).normalized();
    vertex_pseudonormals_[t[0]] += n * cornerAngle(a, b, c);
    vertex_pseudonormals_[t[1]] += n * cornerAngle(b, c, a);
    vertex_pseudonormals_[t[2]] += n * cornerAngle(c, a, b);
    for (int k = 0; k < 3; ++k) {
      auto [at, fresh] = edges.try_emplace(key(t[k], t[(k + 1) % 3]), n);
      if (!fresh) at->second += n;
    }
  }
  for (std::size_t i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k)
      edge_pseudonormals_[i][k] = edges.at(key(triangles_[i][k], triangles_[i][(k + 1) % 3]));
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

void TriangleTree::searchLeaf(const Node& node, const Vec3& p, Nearest* best) const {
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
    const Corners& t = triangles_[i];
    const Vec3 w = closestWeights(p, points_[t[0]], points_[t[1]], points_[t[2]]);
    const Vec3 q = w[0] * points_[t[0]] + w[1] * points_[t[1]] + w[2] * points_[t[2]];
    const double squared = (p - q).squaredNorm();
    if (squared < best->squared) *best = {squared, i, w, q};
  }
}

TriangleTree::Nearest TriangleTree::search(const Vec3& p) const {
  Nearest best{std::numeric_limits<double>::infinity()};
  std::array<std::pair<double, std::uint32_t>, kMaxDepth> stack;
  int top = 0;
  stack[top++] = {nodes_[0].box.squaredExteriorDistance(p), 0};
  while (top > 0) {
    const auto [bound, index] = stack[--top];
    if (bound >= best.squared) continue;
    const Node& node = nodes_[index];
    if (node.count > 0) {
      searchLeaf(node, p, &best);
      continue;
    }
    std::pair<double, std::uint32_t> near{nodes_[index + 1].box.squaredExteriorDistance(p),
                                          index + 1};
    std::pair<double, std::uint32_t> far{nodes_[node.right].box.squaredExteriorDistance(p),
                                         node.right};
    if (far.first < near.first) std::swap(near, far);
    stack[top++] = far;
    stack[top++] = near;
  }
  return best;
}

TriangleTree::Closest TriangleTree::closest(const Vec3& p) const {
  const Nearest best = search(p);
  const double distance = std::sqrt(best.squared);
  const bool inside = pseudonormal(best).dot(p - best.p) < 0;
  return {best.p, interpolated(best.triangle, best.weights), inside ? -distance : distance};
}

TriangleTree::Closest TriangleTree::rounded(const Vec3& p) const {
  const Nearest best = search(p);
  const Corners& t = triangles_[best.triangle];
  const Vec3 normal = interpolated(best.triangle, best.weights);
  const std::array<Vec3, 3> n{normals_[t[0]], normals_[t[1]], normals_[t[2]]};
  Vec3 q = best.p;
  // Where the normals of the corners stand far apart there is an edge, and it stays one.
  if (std::min({n[0].dot(n[1]), n[1].dot(n[2]), n[2].dot(n[0])}) > kSmooth)
    q = roundedPoint({points_[t[0]], points_[t[1]], points_[t[2]]}, n, best.weights);
  return {q, normal, (p - q).dot(normal)};
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

void TriangleTree::cast(const Vec3& start, const Vec3& direction, double length,
                        std::vector<Crossing>* crossings) const {
  const std::size_t before = crossings->size();
  const Vec3 inverse = direction.cwiseInverse();
  const double same = 1e-9 * (1 + length);  // two crossings closer than this are one
  std::array<std::uint32_t, kMaxDepth> stack;
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const std::uint32_t index = stack[--top];
    const Node& node = nodes_[index];
    if (!hitsBox(node.box, start, inverse, length)) continue;
    if (node.count == 0) {
      stack[top++] = node.right;
      stack[top++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Corners& t = triangles_[i];
      // Weights as volumes with the ray; the depth is interpolated from the corners, which stays
      // right for slivers, where a division by the normal would not.
      const Vec3 a = points_[t[0]] - start, b = points_[t[1]] - start, c = points_[t[2]] - start;
      Vec3 w(direction.dot(b.cross(c)), direction.dot(c.cross(a)), direction.dot(a.cross(b)));
      const double sum = w.sum();  // direction . normal, twice the area seen along the ray
      const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      // Edge-on or without area: its neighbours, slightly inclusive, take the ray.
      if (std::abs(sum) < kFlat * longest * longest) continue;
      w /= sum;
      if (w.minCoeff() < -kEdgeTolerance) continue;
      const double s = w.dot(Vec3(a.dot(direction), b.dot(direction), c.dot(direction)));
      if (s < 0 || s > length) continue;
      const bool entering = sum < 0;
      const bool known = std::any_of(
          crossings->begin() + before, crossings->end(),
          [&](auto& other) { return other.entering == entering && std::abs(other.s - s) <= same; });
      if (known) continue;
      Vec3 n = interpolated(i, w);
      if (n.dot(face_normals_[i]) <= 0) n = face_normals_[i];
      crossings->push_back({s, n, entering});
    }
  }
}

Vec3 closestWeights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return {1 - v, v, 0};
  }
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return {1 - w, 0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

}  // namespace palpa::anatomy

#include "anatomy/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anatomy/triangle_distance.h"
#include "anatomy/triangle_tree_build.h"

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

}  // namespace palpa::anatomy

#include <algorithm>
#include <cmath>

#include "anatomy/triangle_tree.h"

namespace palpa::anatomy {
namespace {

double cornerAngle(const Vec3& corner, const Vec3& p, const Vec3& q) {
  const Vec3 u = p - corner, v = q - corner;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// A triangle's edge, so that the same edge of its neighbours sorts beside it.
struct EdgeUse {
  std::uint32_t low, high, triangle;
  int k;
  bool operator<(const EdgeUse& o) const {
    return low != o.low ? low < o.low : high != o.high ? high < o.high : triangle < o.triangle;
  }
};

}  // namespace

void TriangleTree::makePseudonormals() {
  const auto count = static_cast<std::uint32_t>(triangles_.size());
  face_normals_.resize(count);
  vertex_pseudonormals_.assign(points_.size(), Vec3::Zero());
  edge_pseudonormals_.resize(count);
  std::vector<EdgeUse> uses;
  uses.reserve(3 * std::size_t{count});
  for (std::uint32_t i = 0; i < count; ++i) {
    const Corners& t = triangles_[i];
    const auto& [a, b, c] = corners_[i];
    const Vec3 n = face_normals_[i] = (b - a).cross(c - a).normalized();
    vertex_pseudonormals_[t[0]] += n * cornerAngle(a, b, c);
    vertex_pseudonormals_[t[1]] += n * cornerAngle(b, c, a);
    vertex_pseudonormals_[t[2]] += n * cornerAngle(c, a, b);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), i, k});
    }
  }
  std::sort(uses.begin(), uses.end());
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    Vec3 sum = Vec3::Zero();
    for (; end < uses.size() && uses[end].low == uses[begin].low &&
           uses[end].high == uses[begin].high;
         ++end)
      sum += face_normals_[uses[end].triangle];
    for (std::size_t use = begin; use < end; ++use)
      edge_pseudonormals_[uses[use].triangle][uses[use].k] = sum;
  }
}

}  // namespace palpa::anatomy

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// Bounding volume hierarchy over one mesh: exact closest point to a point or a segment and all ray
/// crossings, in the mesh's unit. Nodes of four boxes in single precision, widened so that nothing
/// is missed; split by the surface-area heuristic (Wald 2007); the triangles' corners lie beside
/// each other in leaf order, in double precision, and every answer is computed from them.
/// Immutable; queries use only the stack, so threads may share it.
class TriangleTree {
 public:
  explicit TriangleTree(const TriangleMesh& mesh);

  struct Closest {
    Vec3 p;       ///< on the surface
    Vec3 normal;  ///< interpolated from the vertices, unit
    double signed_distance;
    std::array<std::uint32_t, 3> corners;  ///< vertices of the nearest triangle, as in the mesh
    Vec3 weights;                          ///< barycentric, of `p`
  };
  /// The sign is that of the angle-weighted pseudonormal of the nearest face, edge or vertex
  /// (Baerentzen and Aanaes 2005): right for every closed mesh.
  Closest closest(const Vec3& p) const;

  /// The nearest facet rounded as its vertices' normals ask for: see `roundedPoint`.
  Closest rounded(const Vec3& p) const;

  struct SegmentDistance {
    /// 0 where the segment meets the surface; negative where all of it is inside
    double signed_distance;
    double s;     ///< 0..1: the segment's nearest point a + s (b - a)
    Vec3 p;       ///< the surface's
    Vec3 normal;  ///< interpolated there, unit
  };
  /// Least distance between the segment a-b and the surface, exact: not sampled.
  SegmentDistance nearSegment(const Vec3& a, const Vec3& b) const;

  struct Crossing {
    double s;
    Vec3 normal;
    bool entering;
  };
  /// The crossings of start + s * direction (unit), 0 <= s <= length, unordered; one that runs
  /// through an edge or a vertex shared by several triangles counts once. Writes at most `room` of
  /// them and returns how many it wrote; `*lost` is set when there were more.
  int cast(const Vec3& start, const Vec3& direction, double length, Crossing* crossings, int room,
           bool* lost) const;

  /// Calls f(vertex) for every vertex of a triangle within `reach` of `centre`, each once, always
  /// in the same order.
  template <class F>
  void forVerticesWithin(const Vec3& centre, double reach, F f) const;

  const std::vector<Vec3>& points() const { return points_; }
  const std::vector<Vec3>& normals() const { return normals_; }
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }

 private:
  friend class TriangleTreeBuilder;
  using Corners = std::array<std::uint32_t, 3>;
  using Lanes = Eigen::Array4f;
  /// Four children; boxes about `centre_`. A lane without a child has an empty box at infinity.
  struct alignas(64) Node {
    Lanes low[3], high[3];
    std::array<std::uint32_t, 4> child;
    /// Of each box from q (about `centre_`), 0 inside.
    Lanes squaredFrom(const Eigen::Vector3f& q) const {
      Lanes sum = Lanes::Zero();
      for (int axis = 0; axis < 3; ++axis)
        sum += (low[axis] - q[axis]).max(q[axis] - high[axis]).max(Lanes::Zero()).square();
      return sum;
    }
  };
  // A child is a node's index, or a leaf: a flag, how many triangles it has, and the first one's
  // index.
  static constexpr std::uint32_t kLeaf = 1u << 31, kFirst = (1u << 28) - 1;
  static constexpr int kCountShift = 28;
  static std::uint32_t leafBegin(std::uint32_t child) { return child & kFirst; }
  static std::uint32_t leafEnd(std::uint32_t child) {
    return (child & kFirst) + ((child & ~kLeaf) >> kCountShift);
  }
  struct Nearest {
    double squared;
    std::uint32_t triangle = 0;
    Vec3 weights = Vec3::Zero();  ///< barycentric
    Vec3 p = Vec3::Zero();
  };
  template <class Bound, class Leaf>
  void descend(Bound bound, Leaf leaf, float limit) const;
  Nearest search(const Vec3& p) const;
  void searchLeaf(std::uint32_t child, const Vec3& p, Nearest* best) const;
  void makePseudonormals();
  Vec3 pseudonormal(const Nearest& nearest) const;
  Vec3 interpolated(std::uint32_t triangle, const Vec3& weights) const;

  std::vector<Vec3> points_, normals_;
  std::vector<Corners> triangles_;            ///< in leaf order
  std::vector<std::array<Vec3, 3>> corners_;  ///< their points
  std::vector<std::uint8_t> first_use_;       ///< bit k: no earlier triangle has corner k
  std::vector<Node> nodes_;
  Eigen::AlignedBox3d bounds_;
  Vec3 centre_ = Vec3::Zero();
  std::vector<Vec3> face_normals_, vertex_pseudonormals_;
  std::vector<std::array<Vec3, 3>> edge_pseudonormals_;  ///< edge k runs from corner k to k + 1
};

/// Point of the cubic Bezier triangle over a facet (Vlachos et al. 2001, "curved PN triangles"): it
/// meets the corners p with the normals n, so that a coarse mesh of a smooth shape errs with the
/// fourth power of its edges, not the second. `weights` barycentric.
Vec3 roundedPoint(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& n, const Vec3& weights);

}  // namespace palpa::anatomy

// The walk through the tree: part of triangle_tree.h, which includes it.
namespace palpa::anatomy {

/// The room that a walk needs: a level adds at most three, and TriangleTreeBuilder keeps below
/// these levels.
inline constexpr int kTreeLevels = 64, kTreeStack = 3 * kTreeLevels + 4;

/// Nearest boxes first. `bound(node)` gives a lower bound for each of the four children,
/// `leaf(child, limit)` looks at the triangles of one and returns the limit from then on; what is
/// not below the limit is left out.
template <class Bound, class Leaf>
void TriangleTree::descend(Bound bound, Leaf leaf, float limit) const {
  struct Open {
    float bound;
    std::uint32_t child;
  };
  std::array<Open, kTreeStack> stack;
  int top = 0;
  stack[top++] = {0, 0};
  while (top > 0) {
    const Open open = stack[--top];
    if (!(open.bound < limit)) continue;
    if (open.child & kLeaf) {
      limit = leaf(open.child, limit);
      continue;
    }
    const Node& node = nodes_[open.child];
    const Lanes bounds = bound(node);
    // Insertion into the stack's upper end keeps it sorted, the nearest on top.
    const int from = top;
    for (int lane = 0; lane < 4; ++lane) {
      const Open next{bounds[lane], node.child[lane]};
      if (!(next.bound < limit)) continue;
      int at = top++;
      for (; at > from && stack[at - 1].bound < next.bound; --at) stack[at] = stack[at - 1];
      stack[at] = next;
    }
  }
}

template <class F>
void TriangleTree::forVerticesWithin(const Vec3& centre, double reach, F f) const {
  const Eigen::Vector3f q = (centre - centre_).cast<float>();
  const auto bound = [&q](const Node& node) { return node.squaredFrom(q); };
  const double reach2 = reach * reach;
  const auto leaf = [&](std::uint32_t child, float limit) {
    for (std::uint32_t i = leafBegin(child); i < leafEnd(child); ++i)
      for (int k = 0; k < 3; ++k)
        if ((first_use_[i] >> k & 1) && (corners_[i][k] - centre).squaredNorm() < reach2)
          f(triangles_[i][k]);
    return limit;
  };
  descend(bound, leaf, static_cast<float>(reach2 * (1 + 1e-6)) + std::numeric_limits<float>::min());
}

}  // namespace palpa::anatomy

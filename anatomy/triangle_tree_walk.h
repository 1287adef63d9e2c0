#pragma once

// The walk through the tree: part of triangle_tree.h, which includes it.

#include <limits>

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

#pragma once

#include "anatomy/query/triangle_tree.h"

namespace palpa::anatomy {

/// Fills a tree's nodes and puts its triangles into leaf order. Same mesh, same tree.
class TriangleTreeBuilder {
 public:
  explicit TriangleTreeBuilder(TriangleTree& tree);

 private:
  struct Range {
    std::uint32_t first, count;
  };
  std::uint32_t build(Range range, int level);
  Range cut(Range* range, int level);
  std::uint32_t bestCut(const Range& range, const Eigen::AlignedBox3d& centres);
  std::uint32_t halve(const Range& range, const Eigen::AlignedBox3d& centres);
  Eigen::AlignedBox3d boxOf(const Range& range) const;
  void settle();

  TriangleTree& tree_;
  std::vector<std::uint32_t> order_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<Vec3> centres_;
  double margin_ = 0;
};

}  // namespace palpa::anatomy

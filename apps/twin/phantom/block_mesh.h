#pragma once

#include <array>
#include <vector>

#include "apps/twin/phantom/finite_block.h"

namespace palpa::twin {

/// Hexahedra of half a block, y >= 0, on a grid of planes that are dense where tools press and near
/// the top.
struct BlockMesh {
  std::vector<Vec3> nodes;                 ///< m, undeformed
  std::vector<std::array<int, 8>> bricks;  ///< nodes counter-clockwise below, then above
  std::vector<std::array<int, 4>>
      top;  ///< faces that tools may touch, counter-clockwise from above
  std::vector<bool>
      fixed;  ///< of every coordinate of every node: glued below, in its plane at y = 0
};

BlockMesh meshOf(const SoftBlock& block, const std::vector<double>& tool_x, double tool_radius,
                 const Fineness& fineness);

}  // namespace palpa::twin

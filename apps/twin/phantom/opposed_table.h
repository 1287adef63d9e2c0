#pragma once

#include <array>
#include <vector>

#include "apps/twin/phantom/phantom_table.h"

namespace palpa::twin {

/// One place of two tools on opposite faces of a block: what the block does there.
struct OpposedCell {
  /// N, on each tool: away from the lump, and off the block
  std::array<Eigen::Vector2d, 2> f{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  Eigen::Vector2d lump = Eigen::Vector2d::Zero();  ///< m, its motion: the way the tools are, and up
};

/// Two round tools that pinch a block in a frame, one from above, one from below right opposite,
/// solved once with finite elements and looked up from then on. A lump lies half way between the
/// faces, so each face is the other's mirror image. One tool alone bends the block by `under`, so
/// that the other meets its face later: depths are told from where that face then is,
///     d_1' = d_1 + under(d_2),   d_2' = d_2 + under(d_1)
/// and below zero there is no touch.
struct OpposedTable {
  double tool_radius = 0.008, thickness = 0.03;   ///< m
  double away_step = 0.004, depth_step = 1.3e-3;  ///< m
  int aways = 0, depths = 0;  ///< 0, 1, ... steps from the lump's axis; d' of 1, 2, ... steps
  /// [away][d' of the first][d' of the second, 0, 1, ... steps up to the first's]
  std::vector<OpposedCell> cells;
  std::vector<double> under;  ///< [away][d of one tool alone], m

  /// How far the block gives way under a tool that presses it alone so deep, m; 0: it does not.
  double underAt(double away, double depth) const;
  /// Depths d, m, of both; `share`: of what each does to the other. Between the cells by cubic
  /// interpolation of forces over d'^1.5; beyond the last cell away as there; deeper than the last
  /// one it grows as d'^1.5.
  OpposedCell at(double away, const std::array<double, 2>& depth, double share = 1) const;
};

/// `shape`: radius, thickness, steps and numbers of cells. Throws Error.
OpposedTable tabulateOpposed(const SoftBlock& block, OpposedTable shape, const Fineness& fineness,
                             const Tabulated& progress = {});

}  // namespace palpa::twin

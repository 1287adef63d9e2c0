#pragma once

#include <functional>
#include <vector>

#include "apps/twin/phantom/finite_block.h"

namespace palpa::twin {

/// A round tool's force on the flat top of a block with or without a lump in its middle, solved
/// once with finite elements and looked up from then on. Frame P of SoftBlock.
struct PhantomTable {
  double tool_radius = 0.008;                   ///< m
  double away_step = 0.004, depth_step = 1e-3;  ///< m
  int aways = 0, depths = 0;  ///< away 0, 1, ... steps from above the lump; depth 1, 2, ... steps
  struct Cell {
    double f_out = 0, f_up = 0;  ///< N, on the tool: away from the lump, and up
    double lump_out = 0,
           lump_up = 0;  ///< m, the lump's motion: the way the tool is from it, and up
  };
  std::vector<Cell> cells;  ///< [away][depth]
  /// Between the cells by cubic interpolation of each figure over depth^1.5, which is even or odd
  /// about the lump's axis. Beyond the last cell away as there; deeper than the last one it grows
  /// as depth^1.5. Zero at depth <= 0.
  Cell at(double away, double depth) const;
};

using Tabulated = std::function<void(int done, int of)>;
/// `shape`: radius, steps and numbers of cells. Throws Error.
PhantomTable tabulate(const SoftBlock& block, PhantomTable shape, const Fineness& fineness,
                      const Tabulated& progress = {});

}  // namespace palpa::twin

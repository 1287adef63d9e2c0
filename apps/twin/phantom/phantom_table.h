#pragma once

#include <array>
#include <functional>
#include <vector>

#include "apps/twin/phantom/finite_block.h"

namespace palpa::twin {

/// Catmull-Rom's weights of the four cells around, t of the way from the second to the third.
std::array<double, 4> cubicWeights(double t);

/// One place of a tool in the table: what the phantom does there.
struct PhantomCell {
  double f_out = 0, f_up = 0;  ///< N, on the tool: away from the lump, and up
  double lump_out = 0,
         lump_up = 0;  ///< m, the lump's motion: the way the tool is from it, and up
};

/// A round tool's force on the flat top of a block with or without a lump in its middle, solved
/// once with finite elements and looked up from then on. Frame P of SoftBlock.
struct PhantomTable {
  double tool_radius = 0.008;                   ///< m
  double away_step = 0.004, depth_step = 1e-3;  ///< m
  int aways = 0, depths = 0;  ///< away 0, 1, ... steps from above the lump; depth 1, 2, ... steps
  std::vector<PhantomCell> cells;  ///< [away][depth]
  /// Between the cells by cubic interpolation of each figure over depth^1.5, which is even or odd
  /// about the lump's axis. Beyond the last cell away as there; deeper than the last one it grows
  /// as depth^1.5. Zero at depth <= 0.
  PhantomCell at(double away, double depth) const;
};

using Tabulated = std::function<void(int done, int of)>;
/// `shape`: radius, steps and numbers of cells. Throws Error.
PhantomTable tabulate(const SoftBlock& block, PhantomTable shape, const Fineness& fineness,
                      const Tabulated& progress = {});

/// Two tools side by side: along x and up.
struct PairCell {
  std::array<Eigen::Vector2d, 2> f{Eigen::Vector2d::Zero(),
                                   Eigen::Vector2d::Zero()};  ///< N, on the tools
  Eigen::Vector2d lump = Eigen::Vector2d::Zero();             ///< m, the lump's motion
};

/// Two round tools that press a block together, like two fingers: the first `apart` beyond the
/// second along x, the middle between them shifted from above the lump. Solved once.
struct PairTable {
  double apart = 0.02, shift_step = 0.005, depth_step = 2e-3;  ///< m
  int shifts = 0, depths = 0;  ///< shift 0, 1, ... steps; depth of each tool 1, 2, ... steps
  /// [shift][depth of the first][depth of the second]: what both do more than each alone
  std::vector<PairCell> cells;

  /// What both do more than each alone, by polynomials through all cells; nothing where one does
  /// not press. A shift the other way is the mirror image with the tools swapped. Depths and shifts
  /// beyond the cells are taken for the last ones.
  PairCell more(double shift, const std::array<double, 2>& depth) const;
  /// What each tool does alone, from `one`, and that.
  PairCell at(const PhantomTable& one, double shift, const std::array<double, 2>& depth) const;
};

/// `one`: of the same block; `shape`: distances, steps and numbers of cells. Throws Error.
PairTable tabulatePairs(const SoftBlock& block, const PhantomTable& one, PairTable shape,
                        const Fineness& fineness, const Tabulated& progress = {});

}  // namespace palpa::twin

#pragma once

#include <array>

#include "apps/twin/phantom/phantom_table.h"

namespace palpa::twin {

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
  int shifts = 0, depths = 0;   ///< shift 0, 1, ... steps; depth of each tool 1, 2, ... steps
  std::vector<PairCell> cells;  ///< [shift][depth of the first][depth of the second]: what both do
                                ///< more than each alone

  /// What each tool does alone, from `one`, and what both do more, by polynomials through all
  /// cells; that is nothing where one does not press. A shift the other way is the mirror image
  /// with the tools swapped. Depths and shifts beyond the cells are taken for the last ones.
  PairCell at(const PhantomTable& one, double shift, const std::array<double, 2>& depth) const;
};

/// `one`: of the same block; `shape`: distances, steps and numbers of cells. Throws Error.
PairTable tabulatePairs(const SoftBlock& block, const PhantomTable& one, PairTable shape,
                        const Fineness& fineness, const Tabulated& progress = {});

}  // namespace palpa::twin

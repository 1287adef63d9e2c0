#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace palpa::haptics {

/// A texture of hemispheres on a level disc, one to a cell of a jittered square grid; those whose
/// footprint would cross the inner or the outer rim are left out. Lengths in U, in the disc's
/// frame.
struct BumpSpec {
  double radius = 2;    ///< of a hemisphere
  double spacing = 7;   ///< of the grid
  double jitter = 5.6;  ///< side of the square within which a hemisphere's middle is drawn, evenly
  double inner = 5, outer = 25;
};

/// The bumps, with the grid as their spatial index. Fixed once made: reading it neither allocates
/// nor locks.
class BumpPattern {
 public:
  struct Bump {
    double x = 0, y = 0;
  };
  /// `uniform` draws evenly from [0, 1), two draws a cell, row by row, for those left out as well:
  /// same draws, same bumps. The grid covers the disc of radius `outer`. Throws Error for what is
  /// no pattern.
  BumpPattern(const BumpSpec& spec, const std::function<double()>& uniform);

  const BumpSpec& spec() const noexcept { return spec_; }
  const std::vector<Bump>& bumps() const noexcept { return bumps_; }

  /// Calls `visit(const Bump&)` for every bump whose middle is no farther than `reach` from (x, y),
  /// and perhaps a few more.
  template <typename Visit>
  void near(double x, double y, double reach, Visit visit) const noexcept {
    const int i0 = cell(x - reach - jitterHalf()), i1 = cell(x + reach + jitterHalf());
    const int j0 = cell(y - reach - jitterHalf()), j1 = cell(y + reach + jitterHalf());
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i)
        if (const int k = index_[static_cast<std::size_t>(j * side_ + i)]; k >= 0)
          visit(bumps_[static_cast<std::size_t>(k)]);
  }

  /// Of the highest hemisphere over (x, y), 0 where there is none.
  double height(double x, double y) const noexcept;
  bool covered(double x, double y) const noexcept;  ///< by a footprint, an open disc
  /// The bump whose hemisphere is highest over (x, y), a footprint's edge included; null where
  /// there is none.
  const Bump* over(double x, double y) const noexcept;
  /// Whether the way from a to b enters a footprint in which a is not. One that it only touches, to
  /// 1e-12 of its radius, does not count; of ways that are joined end to end, exactly one enters.
  bool entered(double ax, double ay, double bx, double by) const noexcept;

 private:
  double jitterHalf() const noexcept { return 0.5 * spec_.jitter; }
  int cell(double x) const noexcept;  ///< clamped to the grid

  BumpSpec spec_;
  int side_ = 0;  ///< cells along a side
  std::vector<Bump> bumps_;
  std::vector<int> index_;  ///< by cell; -1: none
};

/// The nearest point found so far of a surface, to a point under it. Lengths in U, in the disc's
/// frame.
struct PatternPoint {
  double x = 0, y = 0, z = 0;
  double distance2 = 0;  ///< squared
};

/// A disc with hemispheres at the point p = (x, y, z) of their solid, the solid being all that lies
/// under the level z = 0 and in the balls around the bumps. The nearest point of its boundary,
/// where bumps have a part in it, is one of
///   on a hemisphere     from its middle through p, where p is at z >= 0 and in the ball
///   on a footprint      the nearest of its circle at z = 0
///   between two         the nearest of the upper half of the circle where their spheres meet,
///                       where p is at z >= 0
///   a vertex            where two footprints' circles cross at z = 0; where three spheres meet at
///                       z > 0
/// each unless another ball holds it; a ball holds what is in it by more than 1e-10. (Under z = 0
/// the nearest of a hemisphere lies on its edge, and of a half circle at its ends.) Replaces `best`
/// by what is nearer. Exact to rounding where the 24 bumps nearest to p decide it: those within 3
/// radii of p, or 5 if so much is covered. What is farther is not looked at; what comes out is free
/// in any case.
void closestOnBumps(const BumpPattern& pattern, double x, double y, double z,
                    PatternPoint* best) noexcept;

}  // namespace palpa::haptics

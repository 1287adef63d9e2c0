#pragma once

#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::twin {

/// A tool's tip that is led from place to place, each time with minimum jerk, and held there. Frame
/// P of twin::SoftBlock.
class LedTip {
 public:
  explicit LedTip(const Vec3& start) : at_(start) { stops_.push_back({start, 0, 0}); }
  LedTip& go(const Vec3& to, double seconds, double hold = 0);
  /// Down to `depth` below `place` and up to 2 mm above it.
  LedTip& press(const Vec3& place, double depth, double seconds_down, double hold = 0);
  double duration() const { return stops_.back().until; }
  Vec3 at(double t) const;

 private:
  struct Stop {
    Vec3 p;
    double arrival, until;  // s
  };
  std::vector<Stop> stops_;
  Vec3 at_;
};

/// Motions of a hand over soft things; `deep` is the deepest, m. Seeded: none is like another.
LedTip pressing(const Vec3& place, double deep, std::uint64_t seed);
LedTip tapping(const Vec3& place, double deep, std::uint64_t seed);
/// Down beside `place`, over it back and forth as far as `reach`, along the direction `way`.
LedTip stroking(const Vec3& place, double deep, double reach, const Vec3& way, std::uint64_t seed);

}  // namespace palpa::twin

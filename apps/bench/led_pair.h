#pragma once

#include <array>

#include "apps/twin/led_tip.h"

namespace palpa::bench {

/// Two tools that keep side by side along x, `apart` from each other, the first beyond: led to the
/// same places in the same time, each to its own depth, m. They start above the surface.
class LedPair {
 public:
  LedPair(double shift, double apart);
  /// `shift`: of the middle between them.
  LedPair& go(double shift, const std::array<double, 2>& depths, double seconds, double hold = 0);
  double duration() const { return tips_[0].duration(); }
  std::array<Vec3, 2> at(double t) const { return {tips_[0].at(t), tips_[1].at(t)}; }

 private:
  double half_;
  std::array<twin::LedTip, 2> tips_;
};

}  // namespace palpa::bench

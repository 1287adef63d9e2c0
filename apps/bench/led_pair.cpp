#include "apps/bench/led_pair.h"

namespace palpa::bench {

namespace {
constexpr double kPairStarts = 2e-3;  // m above the surface
}

LedPair::LedPair(double shift, double apart)
    : half_(0.5 * apart),
      tips_{twin::LedTip(Vec3(shift + half_, 0, kPairStarts)),
            twin::LedTip(Vec3(shift - half_, 0, kPairStarts))} {}

LedPair& LedPair::go(double shift, const std::array<double, 2>& depths, double seconds,
                     double hold) {
  tips_[0].go({shift + half_, 0, -depths[0]}, seconds, hold);
  tips_[1].go({shift - half_, 0, -depths[1]}, seconds, hold);
  return *this;
}

}  // namespace palpa::bench

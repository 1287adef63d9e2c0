#include "apps/bench/phantom_recording.h"

#include <tuple>

#include "apps/bench/sensed_touch.h"

namespace palpa::bench {
const char* nameOf(Noise noise) { return noise == Noise::none ? "none" : "realistic"; }

std::vector<PhantomTick> recordTouch(twin::PhantomTwin phantom, const LedTip& tip, Noise noise, std::uint64_t seed) {
  SensedTouch sensed(seed);
  std::vector<PhantomTick> ticks(static_cast<std::size_t>(tip.duration() / kPhantomTick));
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    PhantomTick& tick = ticks[i];
    tick.true_tip = tip.at(static_cast<double>(i) * kPhantomTick);
    tick.truth = phantom.step(tick.true_tip, kPhantomTick);
    tick.tip = tick.true_tip;
    tick.f_r = tick.truth.f;
    if (noise == Noise::realistic) std::tie(tick.tip, tick.f_r) = sensed.feel(tick.true_tip, tick.truth.f, kPhantomTick);
    if (i > 0) tick.dp = tick.tip - ticks[i - 1].tip;
  }
  return ticks;
}

}  // namespace palpa::bench

#include "haptics/sensors/wrench_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "anatomy/base/error.h"
#include "anatomy/base/pinned_math.h"

namespace palpa::haptics {

LowPass butterworth(double cutoff_Hz, double rate_Hz) {
  if (!(cutoff_Hz > 0) || !(cutoff_Hz < rate_Hz / 2))
    throw UsageError("a cut-off of " + std::to_string(cutoff_Hz) + " Hz at " +
                         std::to_string(rate_Hz) + " samples a second",
                     "force filter", "It must lie between 0 and half the rate.");
  const double K = pinned::tan(std::numbers::pi * cutoff_Hz / rate_Hz);
  const double a0 = 1 + std::numbers::sqrt2 * K + K * K;
  const double b = K * K / a0;
  return {b, 2 * b, b, 2 * (K * K - 1) / a0, (1 - std::numbers::sqrt2 * K + K * K) / a0};
}

namespace {

std::array<double, 6> contactUnfiltered(const WrenchFilter& filter, const Wrench& measured,
                                        const SensorMotion& motion) noexcept {
  const Wrench tool = toolWrench(filter.tool, motion);
  std::array<double, 6> contact;
  for (std::size_t i = 0; i < 3; ++i) {
    contact[i] = measured.f_S[i] - filter.bias.f_S[i] - tool.f_S[i];
    contact[3 + i] = measured.tau_S[i] - filter.bias.tau_S[i] - tool.tau_S[i];
  }
  return contact;
}

}  // namespace

ContactWrench step(const WrenchFilter& filter, WrenchFilterState& state, const WrenchSample& sample,
                   const PackedPose& X_WS, std::int64_t t_ns) noexcept {
  if (!finite(X_WS.p) || !finite(X_WS.q)) {
    state = {};
    return {};
  }
  const Vec3 place = unpack(X_WS.p) + unpack(X_WS.q).normalized() * unpack(filter.p_SK);
  const Packed3 place_before = state.place_before;
  state.place_before = pack(place);
  const SensorMotion& motion = observe(filter.motion, state.motion, X_WS, t_ns);
  const bool usable = !(sample.flags & kUnusable) && finite(sample.f_S) && finite(sample.tau_S);
  const bool ready = usable && state.held && state.motion.poses == 3;
  const auto raw = contactUnfiltered(filter, state.before, motion);
  state.before = {sample.f_S, sample.tau_S};
  state.held = usable;
  if (ready && !state.settled) {
    settle(filter.low_pass, state.low_pass, raw);
    settle(filter.low_pass, state.place, place_before);
  }
  state.settled = ready;
  if (!ready) return {{}, false, pack(place)};
  const auto y = apply(filter.low_pass, state.low_pass, raw);
  return {{{y[0], y[1], y[2]}, {y[3], y[4], y[5]}},
          true,
          apply(filter.low_pass, state.place, place_before)};
}

}  // namespace palpa::haptics

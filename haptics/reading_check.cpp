#include "haptics/reading_check.h"

#include <algorithm>
#include <cmath>

#include "haptics/geometry_check.h"

namespace palpa::haptics {

bool possible(const DeviceReading& reading) noexcept {
  const double size = unpack(reading.q_DE).norm();
  const Packed3& p = reading.p_DE;  // a comparison with a NaN is false
  return std::abs(p[0]) <= kFarthest && std::abs(p[1]) <= kFarthest &&
         std::abs(p[2]) <= kFarthest && size > 0.5 && size < 2;
}

bool steady(const SafetyLimits& limits, std::int64_t period_ns, const NeedlePose& pose,
            std::uint64_t sequence, double elapsed_ns, ReadingState& state) noexcept {
  const double elapsed = std::max(elapsed_ns, 0.0);
  state.since_ns = std::min(state.since_ns + elapsed, static_cast<double>(limits.silent_ns));
  const double moved =
      std::max((pose.p_DE - unpack(state.p_DE)).norm(), (pose.p_DT - unpack(state.p_DT)).norm());
  const double far = limits.max_speed * 1e-9 * (state.since_ns + static_cast<double>(period_ns));
  const bool jumped = state.started && moved > far;
  state.hold_ns =
      jumped ? static_cast<double>(limits.jump_hold_ns) : std::max(state.hold_ns - elapsed, 0.0);
  if (!state.started || sequence != state.sequence || moved > 0) {
    state.p_DE = pack(pose.p_DE);
    state.p_DT = pack(pose.p_DT);
    state.sequence = sequence;
    state.since_ns = 0;
    state.started = 1;
  }
  return state.hold_ns <= 0;
}

}  // namespace palpa::haptics

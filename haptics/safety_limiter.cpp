#include "haptics/safety_limiter.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {
namespace {

/// Falls are free, rises are bounded: what of the last force still points along the wanted one stays,
/// the rest of the way is the rise.
Vec3 limitRise(const Vec3& f, const Vec3& last, double largest_step, bool* limited) {
  const double last2 = last.squaredNorm();
  const double kept = last2 > 0 ? std::clamp(f.dot(last) / last2, 0.0, 1.0) : 0.0;
  const Vec3 base = kept * last;
  const Vec3 rise = f - base;
  const double size = rise.norm();
  *limited = size > largest_step;
  return *limited ? Vec3(base + rise * (largest_step / size)) : f;
}

bool heard(const SafetyLimits& limits, SafetyState& state, const SafetyInput& in) {
  if (!state.started || in.sequence != state.sequence) {
    state.sequence = in.sequence;
    state.t_heard_ns = in.now_ns;
  }
  return in.now_ns - state.t_heard_ns < limits.silent_ns;
}

/// Work done on the hand since the force was last zero.
void accountEnergy(SafetyState& state, const Vec3& p_DE) {
  const Vec3 f = unpack(state.f_last_D);
  if (f.squaredNorm() == 0) {
    state.energy_J = 0;
  } else {
    state.energy_J = std::max(0.0, state.energy_J + f.dot(p_DE - unpack(state.p_last_D)));
  }
}

SafetyCause reasonForZero(const SafetyLimits& limits, SafetyState& state, const SafetyInput& in) {
  const bool device_heard = heard(limits, state, in);
  if (!in.p_DE.allFinite() || !in.f_wanted_D.allFinite()) return SafetyCause::not_finite;
  if (state.started) accountEnergy(state, in.p_DE);
  if (in.emergency_stop) return SafetyCause::emergency_stop;
  if (state.stopped && in.armed) return state.cause;  // only disarming clears a stop
  if (!in.armed) return SafetyCause::not_ready;
  if (state.energy_J > limits.max_energy_J) return SafetyCause::energy;
  return device_heard ? SafetyCause::none : SafetyCause::silent_device;
}

}  // namespace

const char* name(SafetyCause cause) {
  static constexpr const char* kNames[kSafetyCauseCount] = {
      "none",          "not finite",     "clamp",          "slew",     "energy",
      "silent device", "stale geometry", "emergency stop", "watchdog", "not ready"};
  return kNames[static_cast<int>(cause)];
}

Vec3 limitForce(const SafetyLimits& limits, SafetyState& state, const SafetyInput& in) noexcept {
  const SafetyCause zero = reasonForZero(limits, state, in);
  state.started = 1;
  if (in.p_DE.allFinite()) state.p_last_D = pack(in.p_DE);
  state.stopped = zero == SafetyCause::emergency_stop || zero == SafetyCause::energy;
  state.cause = zero;
  if (zero != SafetyCause::none) {
    state.f_last_D = {0, 0, 0};
    return Vec3::Zero();
  }
  Vec3 f = in.f_wanted_D;
  const double size = f.norm();
  if (size > limits.max_force_N) {
    f *= limits.max_force_N / size;
    state.cause = SafetyCause::clamp;
  }
  bool limited = false;
  f = limitRise(f, unpack(state.f_last_D), limits.max_slew_N_per_s * in.dt, &limited);
  if (limited) state.cause = SafetyCause::slew;
  state.f_last_D = pack(f);
  return f;
}

}  // namespace palpa::haptics

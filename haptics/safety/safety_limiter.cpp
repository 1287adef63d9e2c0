#include "haptics/safety/safety_limiter.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {
namespace {

/// Falls are free, rises are bounded: what of the last force still points along the wanted one
/// stays, the rest of the way is the rise.
Vec3 limitRise(const Vec3& f, const Vec3& last, double largest_step, bool* limited) {
  const double last2 = last.squaredNorm();
  const double kept = last2 > 0 ? std::clamp(f.dot(last) / last2, 0.0, 1.0) : 0.0;
  const Vec3 base = kept * last;
  const Vec3 rise = f - base;
  const double size = rise.norm();
  *limited = size > largest_step;
  return *limited ? Vec3(base + rise * (largest_step / size)) : f;
}

/// Time that goes back makes a device neither answer nor fall silent.
bool answers(const SafetyLimits& limits, SafetyState& state, const SafetyInput& in) {
  const double elapsed = static_cast<double>(in.now_ns) - static_cast<double>(state.t_ns);
  state.silence_ns += std::max(elapsed, 0.0);
  state.t_ns = in.now_ns;
  if (!state.started || in.sequence != state.sequence) {
    state.sequence = in.sequence;
    state.silence_ns = 0;
  }
  return state.silence_ns < static_cast<double>(limits.silent_ns);
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

/// The drives warm and cool whatever is asked of them.
void warm(const SafetyLimits& limits, SafetyState& state, double dt) {
  const double f2 = unpack(state.f_last_D).squaredNorm();
  state.heat_N2 += (f2 - state.heat_N2) * std::min(1.0, dt / limits.thermal_tau);
}

constexpr double kWarm = 0.8;  // of the heat that may last: from here on less force

double bearable(const SafetyLimits& limits, const SafetyState& state) {
  if (limits.continuous_force_N <= 0 || limits.continuous_force_N >= limits.max_force_N)
    return limits.max_force_N;
  const double heat = state.heat_N2 / (limits.continuous_force_N * limits.continuous_force_N);
  const double share = std::clamp((heat - kWarm) / (1 - kWarm), 0.0, 1.0);
  return limits.max_force_N + share * (limits.continuous_force_N - limits.max_force_N);
}

SafetyCause stop(SafetyState& state, SafetyCause cause) {
  state.stopped = 1;
  return state.stop_cause = cause;
}

bool believed(const SafetyInput& in) {
  return in.fault == SafetyCause::none && in.p_DE.allFinite() && in.f_wanted_D.allFinite();
}

SafetyCause reasonForZero(const SafetyLimits& limits, SafetyState& state, const SafetyInput& in) {
  const bool device_answers = answers(limits, state, in);
  if (in.emergency_stop) return stop(state, SafetyCause::emergency_stop);
  if (!in.armed) state.stopped = 0;
  if (in.fault != SafetyCause::none) return in.fault;
  if (!believed(in)) return SafetyCause::not_finite;
  if (state.started) accountEnergy(state, in.p_DE);
  if (state.stopped) return state.stop_cause;
  if (!in.armed || !in.homed) return SafetyCause::not_ready;
  if (state.energy_J > limits.max_energy_J) return stop(state, SafetyCause::energy);
  if (limits.deadman_button && !(in.buttons & limits.deadman_button)) return SafetyCause::deadman;
  return device_answers ? SafetyCause::none : SafetyCause::silent_device;
}

}  // namespace

const char* name(SafetyCause cause) {
  static constexpr const char* kNames[kSafetyCauseCount] = {"none",
                                                            "not finite",
                                                            "clamp",
                                                            "slew",
                                                            "energy",
                                                            "silent device",
                                                            "stale geometry",
                                                            "emergency stop",
                                                            "watchdog",
                                                            "not ready",
                                                            "position jump",
                                                            "clock fault",
                                                            "damaged geometry",
                                                            "button not held",
                                                            "warm drives",
                                                            "no force sensor"};
  return kNames[static_cast<int>(cause)];
}

Vec3 limitForce(const SafetyLimits& limits, SafetyState& state, const SafetyInput& in) noexcept {
  const SafetyCause zero = reasonForZero(limits, state, in);
  warm(limits, state, in.dt);
  state.started = 1;
  if (believed(in)) state.p_last_D = pack(in.p_DE);
  state.cause = zero;
  if (zero != SafetyCause::none) {
    state.f_last_D = {0, 0, 0};
    return Vec3::Zero();
  }
  Vec3 f = in.f_wanted_D;
  const double size = f.norm();
  const double most = bearable(limits, state);
  if (size > most) {
    f *= most / size;
    state.cause = most < limits.max_force_N ? SafetyCause::duty : SafetyCause::clamp;
  }
  bool limited = false;
  f = limitRise(f, unpack(state.f_last_D), limits.max_slew_N_per_s * in.dt, &limited);
  if (limited) state.cause = SafetyCause::slew;
  state.f_last_D = pack(f);
  return f;
}

}  // namespace palpa::haptics

#pragma once

#include <type_traits>

#include "haptics/flight_record.h"

namespace palpa::haptics {

/// Limits of the last stage before the device. Cannot be switched off.
struct SafetyLimits {
  double max_force_N = 7.9;
  double max_slew_N_per_s = 2000;      ///< on rises of any component's magnitude; falls are free
  double max_energy_J = 0.25;          ///< net energy given to the hand since the last rest
  std::int64_t silent_ns = 10'000'000; ///< no new reading for this long: zero force
};

struct SafetyState {
  Packed3 f_last_D{};
  Packed3 p_last_D{};
  std::uint64_t sequence = 0;
  std::int64_t t_heard_ns = 0;      ///< when `sequence` last grew
  double energy_J = 0;
  std::uint8_t started = 0;
  std::uint8_t stopped = 0;         ///< emergency stop or energy trip, until re-armed deliberately
  SafetyCause cause = SafetyCause::none;
  std::uint8_t reserved[5]{};
};
static_assert(std::is_trivially_copyable_v<SafetyState>);

struct SafetyInput {
  std::int64_t now_ns = 0;
  double dt = 0.001;
  Vec3 f_wanted_D = Vec3::Zero();
  Vec3 p_DE = Vec3::Zero();
  std::uint64_t sequence = 0;
  bool armed = false;
  bool emergency_stop = false;
};

/// Finite check (zero at once), silent device, emergency stop, energy bound, force clamp, slew limit on
/// rises. Returns the force to command; `state.cause` says what was done about it (none: nothing).
Vec3 limitForce(const SafetyLimits& limits, SafetyState& state, const SafetyInput& input) noexcept;

}  // namespace palpa::haptics

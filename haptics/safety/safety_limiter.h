#pragma once

#include <type_traits>

#include "haptics/flight_record.h"

namespace palpa::haptics {

/// Limits of the last stage before the device. Cannot be switched off.
struct SafetyLimits {
  double max_force_N = 7.9;
  double max_slew_N_per_s = 2000;  ///< on rises of any component's magnitude; falls are free
  /// What the drives bear for long, N rms over `thermal_tau`; 0: no such limit. Heat h follows
  /// |f|^2 as
  ///   dh/dt = (|f|^2 - h) / tau
  /// and from h = 80 % of continuous^2 on, the largest force goes down evenly to `continuous` at
  /// 100 %.
  double continuous_force_N = 0;
  double thermal_tau = 60;              ///< s
  double max_energy_J = 0.25;           ///< net energy given to the hand since the last rest
  std::int64_t silent_ns = 10'000'000;  ///< no new reading for this long: zero force
  /// the loop stood still for longer: zero force in its next tick
  std::int64_t watchdog_ns = 10'000'000;
  /// m/s. A movement of 10 cm from rest to rest peaks at 1.875 x 0.1 m / T (minimum jerk, Flash and
  /// Hogan 1985): 5 m/s would be T = 38 ms, less than a reflex takes. Faster is a fault of the
  /// device.
  double max_speed = 5;
  /// steady for this long after a jump before force returns
  std::int64_t jump_hold_ns = 10'000'000;
  /// bits of DeviceReading::buttons, one of them held or no force; 0: off
  std::uint32_t deadman_button = 0;
  std::uint32_t reserved = 0;
};

struct SafetyState {
  Packed3 f_last_D{};
  Packed3 p_last_D{};
  std::uint64_t sequence = 0;
  std::int64_t t_ns = 0;  ///< of the last call
  double silence_ns = 0;  ///< since `sequence` last changed
  double energy_J = 0;
  double heat_N2 = 0;  ///< h
  std::uint8_t started = 0;
  std::uint8_t stopped = 0;  ///< emergency stop or energy trip, until re-armed deliberately
  SafetyCause stop_cause = SafetyCause::none;
  SafetyCause cause = SafetyCause::none;
  std::uint8_t reserved[4]{};
};
static_assert(std::is_trivially_copyable_v<SafetyState>);

struct SafetyInput {
  std::int64_t now_ns = 0;
  double dt = 0.001;
  Vec3 f_wanted_D = Vec3::Zero();
  Vec3 p_DE = Vec3::Zero();
  std::uint64_t sequence = 0;
  std::uint32_t buttons = 0;
  SafetyCause fault = SafetyCause::none;  ///< found before: zero force for this reason
  bool armed = false;                     ///< taking this away, and only this, clears a stop
  bool homed = true;
  bool emergency_stop = false;
};

/// Emergency stop, finite check, faults found before (zero at once), silent device, dead man's
/// button, energy bound, force clamp, duty, slew limit on rises. Returns the force to command;
/// `state.cause` says what was done about it (none: nothing). A stop outlasts any other fault.
Vec3 limitForce(const SafetyLimits& limits, SafetyState& state, const SafetyInput& input) noexcept;

}  // namespace palpa::haptics

#pragma once

#include <gtest/gtest.h>

#include "fault_world.h"
#include "haptics/loop/tick_config.h"
#include "haptics/loop/tick_state.h"

namespace palpa::haptics {

/// Knows from the inputs alone when there must be no force, and says whether a tick kept to it.
class FaultJudge {
 public:
  /// `state` after the tick; read only for which snapshot was taken and whether energy tripped.
  void judge(const FaultyWorld& world, const TickState& state, const FlightRecord& record) {
    elapsed_ = first_ ? world.config.period_ns : world.now - last_.t_ns;
    watch(world);
    wanted_absurd_ = !unpack(record.f_wanted_D).allFinite();
    withinLimits(world.config.safety, unpack(record.f_command_D));
    EXPECT_TRUE(std::isfinite(state.passivity.energy_J) &&
                unpack(state.passivity.f_last_D).allFinite() &&
                unpack(state.passivity.added_D).allFinite())
        << "what is not a number stays in the state";
    // By number and time: random bytes may have given the number alone to an earlier one, which was
    // plausible.
    if (world.damaged) {
      EXPECT_FALSE(state.now.number == world.offered.number && state.now.t_ns == world.offered.t_ns)
          << "a damaged snapshot was adopted";
      EXPECT_FALSE(record.events & kSnapshotAdopted)
          << "the record says that a damaged snapshot was adopted";
    }
    const std::string why = mustBeZero(world, state);
    const bool zero = record.f_command_D == Packed3{0, 0, 0};
    if (!why.empty()) {
      EXPECT_TRUE(zero) << why << ", yet " << unpack(record.f_command_D).norm() << " N, cause "
                        << name(record.safety);
      EXPECT_GE(rank(record.safety), 1) << why << ", yet the record says " << name(record.safety);
    }
    if (zero && record.f_wanted_D != Packed3{0, 0, 0}) {
      EXPECT_GE(rank(record.safety), 1) << "force taken away without a cause";
    }
    EXPECT_TRUE(isSo(record.safety, world, state)) << "the record claims " << name(record.safety);
    if (rank(record.safety) == 2 && record.safety != last_.safety) {
      EXPECT_TRUE(record.events & kSafetyTripped) << name(record.safety);
    }
    ++seen[static_cast<int>(record.safety)];
    if (!why.empty() && !first_ && last_.f_command_D != Packed3{0, 0, 0}) ++taken_away;
    pushed += !zero;
    first_ = false;
    last_ = record;
  }

  std::int64_t seen[kSafetyCauseCount]{}, taken_away = 0, pushed = 0;

 private:
  /// 0: the force is rendered; 1: no force, as it should be; 2: no force because something failed.
  static int rank(SafetyCause cause) {
    if (cause == SafetyCause::none || cause == SafetyCause::clamp || cause == SafetyCause::slew ||
        cause == SafetyCause::duty)
      return 0;
    return cause == SafetyCause::not_ready || cause == SafetyCause::deadman ? 1 : 2;
  }

  void watch(const FaultyWorld& w) {
    silent_ = first_ || w.reading.sequence != last_.reading.sequence
                  ? 0
                  : silent_ + std::max<std::int64_t>(elapsed_, 0);
    steady_ += std::max<std::int64_t>(elapsed_, 0);
    homed_ += std::max<std::int64_t>(elapsed_, 0);
    if (!w.reading.homed) {
      placed_ = false;
      homed_ = 0;
    }
    // Where a device is that does not know where it is, says nothing of where it was
    if (!w.reading_absurd && w.reading.homed) {
      const Vec3 p = unpack(w.reading.p_DE);
      const Vec3 tip = p + unpack(w.reading.q_DE) * unpack(w.config.X_ET.p);
      // Farther than 5 m/s reaches in the 11 ms that count at most: 55 mm.
      if (placed_ && std::max((p - p_).norm(), (tip - tip_).norm()) > 0.056) steady_ = 0;
      p_ = p;
      tip_ = tip;
      placed_ = true;
    }
    if (w.commands.emergency_stop)
      stopped_ = true;
    else if (!w.commands.armed)
      stopped_ = false;
  }

  void withinLimits(const SafetyLimits& limits, const Vec3& f) {
    ASSERT_TRUE(f.allFinite());
    EXPECT_LE(f.norm(), limits.max_force_N * (1 + 1e-12));
    // Heat, reckoned anew: at or over what may last there is no more than what may last.
    const double lasting = limits.continuous_force_N;
    const double step =
        std::clamp(static_cast<double>(elapsed_) * 1e-9, 0.0, 0.005) / limits.thermal_tau;
    heat_ += ((first_ ? 0 : unpack(last_.f_command_D).squaredNorm()) - heat_) * std::min(1.0, step);
    if (lasting > 0 && heat_ >= lasting * lasting) {
      EXPECT_LE(f.norm(), std::max(lasting, 0.0) * (1 + 1e-9)) << "too warm";
    }
    const Vec3 last = first_ ? Vec3(Vec3::Zero()) : unpack(last_.f_command_D);
    const double last2 = last.squaredNorm();
    const double kept = last2 > 0 ? std::clamp(f.dot(last) / last2, 0.0, 1.0) : 0;
    const double dt = std::clamp(static_cast<double>(elapsed_) * 1e-9, 0.0, 0.005);
    EXPECT_LE((f - kept * last).norm(), limits.max_slew_N_per_s * dt * (1 + 1e-9) + 1e-12)
        << "rise";
  }

  double age(const FaultyWorld& w, const TickState& state) const {
    return static_cast<double>(w.now) - static_cast<double>(state.now.t_ns);
  }

  std::string mustBeZero(const FaultyWorld& w, const TickState& state) const {
    if (w.commands.emergency_stop) return "emergency stop";
    if (stopped_) return "stopped, not re-armed";
    if (w.reading_absurd) return "absurd reading";
    if (homed_ < 10'000'000) return "not homed, or only just";
    if (steady_ < 10'000'000) return "jump";
    if (elapsed_ <= 0) return "clock";
    if (elapsed_ > 10'000'000) return "late loop";
    if (silent_ >= 10'000'000) return "silent device";
    if (!w.commands.armed || !w.reading.homed) return "not ready";
    if (w.config.safety.deadman_button && !(w.reading.buttons & 4)) return "button released";
    if (w.config.contact_mode == ContactMode::floor) return "";
    if (w.config.contact_mode == ContactMode::sensed_object)
      return sensorLost(w) ? "no force sensor" : "";
    const double limit = static_cast<double>(w.config.age_limit_ns + w.config.fade_ns);
    if (state.now.number == 0 || std::abs(age(w, state)) >= limit) return "stale geometry";
    return "";
  }

  static bool sensorLost(const FaultyWorld& w) {
    return w.sensor_absurd || w.sensed.state != SensorState::valid;
  }

  /// Whether what the record claims is the case.
  bool isSo(SafetyCause cause, const FaultyWorld& w, const TickState& state) const {
    const bool stale = state.now.number == 0 ||
                       std::abs(age(w, state)) > static_cast<double>(w.config.age_limit_ns);
    switch (cause) {
      case SafetyCause::not_finite:
        return w.reading_absurd || wanted_absurd_;
      case SafetyCause::silent_device:
        return silent_ >= 10'000'000;
      case SafetyCause::stale_geometry:
        return stale && state.refused == 0;
      case SafetyCause::corrupt_geometry:
        return stale && state.refused != 0;
      case SafetyCause::emergency_stop:
        return stopped_;
      case SafetyCause::watchdog:
        return elapsed_ > 10'000'000;
      case SafetyCause::not_ready:
        return !w.commands.armed || !w.reading.homed || homed_ < 10'000'000 || state.homing_ns > 0;
      case SafetyCause::jump:
        return steady_ < 10'000'000 || state.reading.hold_ns > 0;
      case SafetyCause::clock:
        return elapsed_ <= 0;
      case SafetyCause::deadman:
        return w.config.safety.deadman_button && !(w.reading.buttons & 4);
      case SafetyCause::duty:
        return w.config.safety.continuous_force_N > 0;
      case SafetyCause::no_sensor:
        return w.config.contact_mode == ContactMode::sensed_object && sensorLost(w);
      case SafetyCause::energy:
        return state.safety.stopped;
      default:
        return true;
    }
  }

  bool first_ = true, placed_ = false, stopped_ = false, wanted_absurd_ = false;
  std::int64_t elapsed_ = 0, silent_ = 0, steady_ = 1'000'000'000, homed_ = 1'000'000'000;
  Vec3 p_ = Vec3::Zero(), tip_ = Vec3::Zero();
  double heat_ = 0;
  FlightRecord last_;
};

}  // namespace palpa::haptics

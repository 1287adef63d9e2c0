#pragma once

#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"

namespace palpa::runtime {

/// RECORDER: drains what the others queued into the session's evidence and commits it every 100
/// ticks.
class RecorderActivity final : public Activity {
 public:
  RecorderActivity(Bus& bus, FlightSink& sink,
                   std::int64_t tick_period_ns = haptics::TickConfig{}.period_ns)
      : bus_(bus), sink_(sink), period_ns_(kTicks * tick_period_ns) {}
  const char* name() const override { return "recorder"; }
  std::int64_t step(std::int64_t now_ns) override;
  /// After the executive has stopped: the rest.
  void finish() { drain(); }

  /// Records lost because the recorder could not keep up; 0 in virtual time.
  std::uint64_t dropped() const {
    return bus_.haptic_to_recorder.overflows() + bus_.geometry_to_recorder.overflows() +
           bus_.keyframes_to_recorder.overflows() + bus_.task_to_recorder.overflows();
  }

 private:
  static constexpr std::int64_t kTicks =
      100;  ///< half of what a killed process may lose; the queue holds 8192
  void drain();
  Bus& bus_;
  FlightSink& sink_;
  const std::int64_t period_ns_;
};

}  // namespace palpa::runtime

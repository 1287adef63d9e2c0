#pragma once

#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"

namespace palpa::runtime {

/// RECORDER: drains what the others queued into the session's evidence and commits ten times a
/// second.
class RecorderActivity final : public Activity {
 public:
  RecorderActivity(Bus& bus, FlightSink& sink) : bus_(bus), sink_(sink) {}
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
  void drain();
  Bus& bus_;
  FlightSink& sink_;
};

}  // namespace palpa::runtime

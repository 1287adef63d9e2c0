#pragma once

#include "apps/runtime/activity.h"
#include "apps/runtime/event_queue.h"
#include "apps/runtime/flight_sink.h"
#include "haptics/devices/falcon_driver.h"

namespace palpa::runtime {

/// DEVICE: a Falcon's own thread. Opens it, exchanges packets when they are due, tells what the
/// person at the station has to know (kind "device", at every change); its end, whatever the
/// reason, sends zero force.
class FalconActivity final : public Activity {
 public:
  FalconActivity(haptics::FalconDriver& driver, EventQueue<Event>& notices)
      : driver_(driver), notices_(notices) {}
  const char* name() const override { return "falcon"; }
  std::int64_t step(std::int64_t now_ns) override;
  void end() noexcept override;  ///< zero force, closed

 private:
  haptics::FalconDriver& driver_;
  EventQueue<Event>& notices_;
  haptics::FalconState told_state_ = haptics::FalconState::closed;
  haptics::FalconProblem told_problem_ = haptics::FalconProblem::none;
  bool opened_ = false;
};

}  // namespace palpa::runtime

#pragma once

#include <array>

#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"
#include "apps/runtime/force_sensing.h"
#include "haptics/device.h"
#include "haptics/tick_pair.h"

namespace palpa::runtime {

/// HAPTIC where two devices touch one real thing, every `TickConfig::period_ns` of the first: both
/// devices and their sensors -> tickPair -> both devices. Never allocates (in real time), locks,
/// logs or throws. Every tick is recorded twice, the first device's record before the second's.
class HapticPairActivity final : public Activity {
 public:
  struct Tool {
    haptics::HapticDevice& device;
    ForceSensing& sensing;
  };
  HapticPairActivity(Bus& bus, const std::array<Tool, 2>& tools, const haptics::PairConfig& config)
      : bus_(bus), tools_(tools), config_(config) {}
  const char* name() const override { return "haptic"; }
  std::int64_t step(std::int64_t now_ns) override;
  std::int64_t period_ns() const override { return config_.tools[0].period_ns; }

 private:
  Bus& bus_;
  std::array<Tool, 2> tools_;
  const haptics::PairConfig config_;
  haptics::PairState state_;
  std::int64_t due_ns_ = -1;
};

}  // namespace palpa::runtime

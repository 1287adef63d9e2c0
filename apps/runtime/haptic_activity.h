#pragma once

#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"
#include "haptics/device.h"
#include "haptics/tick.h"

namespace palpa::runtime {

inline constexpr std::int64_t kKeyframeTicks = 200;

/// HAPTIC, every `TickConfig::period_ns` (1 to 4 kHz): device -> tick -> device. Never allocates (in real time), locks, logs or throws.
class HapticActivity final : public Activity {
 public:
  HapticActivity(Bus& bus, haptics::HapticDevice& device, const haptics::TickConfig& config)
      : bus_(bus), device_(device), config_(config) {}
  const char* name() const override { return "haptic"; }
  std::int64_t step(std::int64_t now_ns) override;
  std::int64_t period_ns() const override { return config_.period_ns; }

 private:
  void tell(const haptics::FlightRecord& record, std::int64_t now_ns);

  Bus& bus_;
  haptics::HapticDevice& device_;
  const haptics::TickConfig config_;
  haptics::TickState state_;
  std::int64_t due_ns_ = -1;
};

}  // namespace palpa::runtime

#pragma once

#include <atomic>

#include "apps/runtime/state_channel.h"
#include "haptics/device.h"
#include "haptics/safety_limiter.h"

namespace palpa::runtime {

/// A haptic device whose readings and commands cross to another activity (a driver's thread, the
/// virtual bench, the mouse): the tick only exchanges latest values with it. The other side is the
/// haptic loop's watchdog: where the loop has not commanded for `command_life_ns`, the force is
/// zero.
class ChannelDevice final : public haptics::HapticDevice {
 public:
  ChannelDevice(haptics::DeviceCapabilities capabilities, TimeMode mode,
                std::int64_t command_life_ns = haptics::SafetyLimits{}.watchdog_ns)
      : capabilities_(std::move(capabilities)),
        command_life_ns_(command_life_ns),
        readings_(mode),
        commands_(mode) {}

  const haptics::DeviceCapabilities& capabilities() const override { return capabilities_; }
  haptics::DeviceReading read(std::int64_t now_ns) noexcept override {
    const haptics::DeviceReading* reading = readings_.read(now_ns);
    return reading ? *reading : haptics::DeviceReading{};
  }
  void command(std::int64_t now_ns, const Packed3& f_D) noexcept override {
    commands_.publish({now_ns, f_D}, now_ns);
  }

  /// The other side's ends.
  void publish(const haptics::DeviceReading& reading, std::int64_t now_ns) {
    readings_.publish(reading, now_ns);
  }
  Packed3 commanded(std::int64_t now_ns) {
    const Command* command = commands_.read(now_ns);
    if (!command) return {0, 0, 0};
    const bool overdue = now_ns - command->t_ns > command_life_ns_;
    if (overdue && !overdue_) timeouts_.fetch_add(1, std::memory_order_relaxed);
    overdue_ = overdue;
    return overdue ? Packed3{0, 0, 0} : command->f_D;
  }

  /// How often the loop let a command grow too old; any thread may ask.
  std::uint64_t timeouts() const noexcept { return timeouts_.load(std::memory_order_relaxed); }

 private:
  struct Command {
    std::int64_t t_ns = 0;
    Packed3 f_D{0, 0, 0};
  };
  haptics::DeviceCapabilities capabilities_;
  const std::int64_t command_life_ns_;
  StateChannel<haptics::DeviceReading> readings_;
  StateChannel<Command> commands_;
  bool overdue_ = false;  // the other side's
  std::atomic<std::uint64_t> timeouts_{0};
};

}  // namespace palpa::runtime

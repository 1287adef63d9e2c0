#pragma once

#include "apps/runtime/state_channel.h"
#include "haptics/device.h"

namespace palpa::runtime {

/// A haptic device whose readings and commands cross to another activity (a driver's thread, the
/// virtual bench, the mouse): the tick only exchanges latest values with it.
class ChannelDevice final : public haptics::HapticDevice {
 public:
  ChannelDevice(haptics::DeviceCapabilities capabilities, TimeMode mode)
      : capabilities_(std::move(capabilities)), readings_(mode), commands_(mode) {}

  const haptics::DeviceCapabilities& capabilities() const override { return capabilities_; }
  haptics::DeviceReading read(std::int64_t now_ns) noexcept override {
    const haptics::DeviceReading* reading = readings_.read(now_ns);
    return reading ? *reading : haptics::DeviceReading{};
  }
  void command(std::int64_t now_ns, const Packed3& f_D) noexcept override {
    commands_.publish(f_D, now_ns);
  }

  /// The other side's ends.
  void publish(const haptics::DeviceReading& reading, std::int64_t now_ns) {
    readings_.publish(reading, now_ns);
  }
  Packed3 commanded(std::int64_t now_ns) {
    const Packed3* f = commands_.read(now_ns);
    return f ? *f : Packed3{0, 0, 0};
  }

 private:
  haptics::DeviceCapabilities capabilities_;
  StateChannel<haptics::DeviceReading> readings_;
  StateChannel<Packed3> commands_;
};

}  // namespace palpa::runtime

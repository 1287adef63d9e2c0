#pragma once

#include "apps/bench/stroke.h"
#include "apps/runtime/bus.h"
#include "apps/runtime/channel_device.h"

namespace palpa::bench {

/// A device that is led along a stroke: its reading at `now_ns`.
class LedDevice {
 public:
  LedDevice(const StrokeSettings& stroke, runtime::ChannelDevice& device)
      : stroke_(stroke), device_(device) {}
  haptics::DeviceReading lead(std::int64_t now_ns);

 private:
  StrokeSettings stroke_;
  runtime::ChannelDevice& device_;
  std::uint64_t sequence_ = 0;
};

/// Lets the haptic loop render: what a task would say when a trial runs.
void arm(runtime::Bus& bus);

/// Takes off the bus what recorder and task would; records and snapshots go to `result` where there
/// is one. Returns how many of the ticks felt a contact.
std::uint64_t drain(runtime::Bus& bus, StrokeResult* result);

}  // namespace palpa::bench

#pragma once

#include "apps/runtime/state_channel.h"
#include "haptics/sensors/force_sensor.h"

namespace palpa::runtime {

/// A force sensor whose samples cross from another activity (the virtual bench): latest wins. Older
/// than `silent_ns`: kSilent.
class ChannelSensor final : public haptics::ForceSensor {
 public:
  ChannelSensor(haptics::ForceSensorCapabilities capabilities, TimeMode mode,
                std::int64_t silent_ns = 10'000'000)
      : capabilities_(std::move(capabilities)), silent_ns_(silent_ns), samples_(mode) {}
  const haptics::ForceSensorCapabilities& capabilities() const override { return capabilities_; }
  haptics::WrenchSample read(std::int64_t now_ns) noexcept override {
    haptics::WrenchSample sample;
    sample.flags = haptics::kNothingYet;
    if (const haptics::WrenchSample* latest = samples_.read(now_ns)) {
      sample = *latest;
      if (now_ns - sample.t_ns > silent_ns_) sample.flags |= haptics::kSilent;
    }
    return sample;
  }
  void publish(const haptics::WrenchSample& sample, std::int64_t now_ns) {
    samples_.publish(sample, now_ns);
  }

 private:
  haptics::ForceSensorCapabilities capabilities_;
  const std::int64_t silent_ns_;
  StateChannel<haptics::WrenchSample> samples_;
};

}  // namespace palpa::runtime

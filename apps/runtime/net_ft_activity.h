#pragma once

#include "apps/runtime/activity.h"
#include "haptics/sensors/net_ft_sensor.h"

namespace palpa::runtime {

/// DEVICE: the thread that waits for a Net F/T's datagrams; `sensor` has been started. Real time
/// only: a step lasts until something comes, or the sensor's `wait_ms`.
class NetFtActivity final : public Activity {
 public:
  explicit NetFtActivity(haptics::NetFtSensor& sensor) : sensor_(sensor) {}
  const char* name() const override { return "force sensor"; }
  std::int64_t step(std::int64_t now_ns) override {
    sensor_.step();
    return now_ns;
  }

 private:
  haptics::NetFtSensor& sensor_;
};

}  // namespace palpa::runtime

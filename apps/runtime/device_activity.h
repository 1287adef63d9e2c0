#pragma once

#include <atomic>

#include "apps/runtime/activity.h"
#include "apps/runtime/channels.h"
#include "apps/runtime/flight_sink.h"
#include "haptics/devices/driver.h"
#include "haptics/sensors/net_ft_sensor.h"

namespace palpa::runtime {

/// DEVICE: a driver's own thread. Opens the device, exchanges with it when that is due, tells what
/// the person at the station has to know (kind "device", at every change); its end, whatever the
/// reason, sends zero force.
class DriverActivity final : public Activity {
 public:
  DriverActivity(haptics::Driver& driver, EventQueue<Event>& notices)
      : driver_(driver), notices_(notices) {}
  const char* name() const override { return "device"; }
  std::int64_t step(std::int64_t now_ns) override;
  void end() noexcept override;  ///< zero force, closed
  /// Its last step left it ready: a force may be on it, and no step may take long. Any thread.
  bool mayPush() const noexcept { return may_push_.load(); }

 private:
  haptics::Driver& driver_;
  EventQueue<Event>& notices_;
  haptics::DriverStatus reported_;
  bool opened_ = false;
  std::atomic<bool> may_push_{false};
};

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

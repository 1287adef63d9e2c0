#pragma once

#include "haptics/flight_record.h"
#include "haptics/sensors/wrench_filter.h"

namespace palpa::runtime {

/// A force sensor on the tool, read in the haptic thread: its newest sample, cleared of bias, tool
/// and noise (WrenchFilter), as the force of a real object on the tool, in D. The tool's motion is
/// that of the device's readings at their own times, however often the loop asks; unusable until
/// the device is homed. After a gap in the readings the motion takes three of them to be known
/// again: so long the last force holds, but no longer than `kGoodFor_ns` and only while the sensor
/// itself is well. Never allocates, never throws.
class ForceSensing {
 public:
  static constexpr std::int64_t kGoodFor_ns = 10'000'000;  ///< as old as a sample may be

  struct Setup {
    haptics::WrenchFilter filter;  ///< its motion at the device's rate, its low-pass at the loop's;
                                   ///< K: the tool's tip, or a round tip's middle
    Pose X_WD = Pose::Identity();  ///< which way is down
    Pose X_ES = Pose::Identity();  ///< the sensor on the end effector
  };
  ForceSensing(haptics::ForceSensor& sensor, const Setup& setup) : sensor_(sensor), setup_(setup) {}

  haptics::SensedForce sense(const haptics::DeviceReading& reading, std::int64_t now_ns) noexcept;

 private:
  haptics::ForceSensor& sensor_;
  Setup setup_;
  haptics::WrenchFilterState state_;
  haptics::SensedForce last_;  // valid
  std::int64_t last_ns_ = -kGoodFor_ns - 1;
};

}  // namespace palpa::runtime

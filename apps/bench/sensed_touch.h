#pragma once

#include <cstdint>
#include <utility>

#include "apps/twin/device_twin.h"
#include "apps/twin/sensor_twin.h"
#include "haptics/sensors/wrench_filter.h"

namespace palpa::bench {

/// A tool's tip and the reaction on it, as a station knows them: a device's encoders; a sensor on
/// its last link that carries the tool, whose mass was identified to 1 % and whose bias to 5 mN
/// [chosen]. Both through one low-pass, so that they are late by the same.
class SensedTouch {
 public:
  explicit SensedTouch(std::uint64_t seed, const twin::DeviceTruth& device = {});
  /// The next tick: measured tip, m, and reaction, N, in P. The tool stands upright.
  std::pair<Vec3, Vec3> feel(const Vec3& true_tip, const Vec3& f_touch, double dt);

 private:
  twin::DeviceTruth device_;
  twin::SensorTwin sensor_;
  haptics::WrenchFilter filter_;
  haptics::WrenchFilterState state_;
  std::int64_t t_ns_ = 0;
};

}  // namespace palpa::bench

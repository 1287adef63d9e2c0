#pragma once

#include <vector>

#include "apps/station/json_file.h"
#include "haptics/sensors/force_sensor.h"
#include "haptics/sensors/tool_load.h"

namespace palpa::twin {

/// What shall go wrong with the virtual force sensor, and when: "twin/sensor_faults" of a station's
/// file, a list of {"kind", "from_s", "to_s"}; session time.
///   unplugged   no samples         saturated     it says that its gauges are    drifting   its
///   zero wanders by "rate_N_per_s" reversed    every sign is the other one      wrong_scale forces
///   and torques times "factor"
struct SensorFault {
  enum class Kind { unplugged, saturated, drifting, reversed, wrong_scale };
  Kind kind = Kind::unplugged;
  double from = 0, to = 0;  ///< s
  double amount = 0;        ///< N/s; of the true force
};

/// Throws UsageError for a kind that is not known and for spans that are none.
std::vector<SensorFault> readSensorFaults(const station::JsonFile& file);

/// The sample as the faults of time `t`, s, leave it; false: there is none. `zero`: what the
/// station takes off as bias.
bool spoil(const std::vector<SensorFault>& faults, double t, const haptics::Wrench& zero,
           haptics::WrenchSample* sample);

}  // namespace palpa::twin

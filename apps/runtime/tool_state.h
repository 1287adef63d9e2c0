#pragma once

#include "apps/runtime/bus.h"
#include "haptics/tick.h"

namespace palpa::runtime {

/// What a recorded tick alone tells of the tool at X_DT: no speed, no point of entry.
ToolState toolStateOf(const PackedPose& X_DT, const haptics::FlightRecord& record);
/// What the slower activities are told of a tool after a tick.
ToolState toolStateOf(const haptics::TickConfig& config, const haptics::TickState& state,
                      const haptics::FlightRecord& record, std::int64_t now_ns);

}  // namespace palpa::runtime

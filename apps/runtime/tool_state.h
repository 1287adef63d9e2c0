#pragma once

#include "apps/runtime/bus.h"
#include "haptics/tick.h"

namespace palpa::runtime {

/// What the slower activities are told of a tool after a tick.
ToolState toolStateOf(const haptics::TickConfig& config, const haptics::TickState& state, const haptics::FlightRecord& record, std::int64_t now_ns);

}  // namespace palpa::runtime

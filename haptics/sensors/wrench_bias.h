#pragma once

#include <span>

#include "haptics/sensors/force_sensor.h"
#include "haptics/sensors/tool_load.h"

namespace palpa::haptics {

struct BiasEstimate {
  Wrench bias;
  Wrench sd;  ///< of a single sample: noise, or a hand on the tool
};

/// bias = mean of (measured - tool's weight), with the tool at rest and nothing touching it.
/// g_S: gravity in S, m/s^2. Throws Error when there are fewer than two samples or one is unusable.
BiasEstimate wrenchBias(std::span<const WrenchSample> samples, const ToolLoad& tool,
                        const Packed3& g_S);

}  // namespace palpa::haptics

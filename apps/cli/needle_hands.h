#pragma once

#include "apps/cli/needle_world.h"
#include "apps/cli/session_devices.h"

namespace palpa::cli {

/// Who may hold the needle: a simulated operator, as the options ask for one, or somebody with a
/// mouse.
SessionDevices::Hands needleHands(const SessionOptions& options, const NeedleWorld& world);

}  // namespace palpa::cli

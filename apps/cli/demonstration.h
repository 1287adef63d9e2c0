#pragma once

#include <filesystem>

#include "apps/cli/needle_world.h"

namespace palpa::cli {

/// An expert's trial to watch before one's own: recorded on the virtual bench (labelled simulated),
/// then played back in the window at its own speed, from the record alone. Enter or Escape ends it.
void showDemonstration(const SessionOptions& options, NeedleWorld& world,
                       const std::filesystem::path& folder);

}  // namespace palpa::cli

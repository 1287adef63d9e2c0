#pragma once

#include <filesystem>
#include <vector>

#include "apps/cli/needle_world.h"
#include "apps/cli/session_frame.h"
#include "apps/task_needle/scene_activity.h"

namespace palpa::cli {

struct SessionResult : SessionRun {
  std::vector<task_needle::CompletedTrial> trials;
};

/// Runs the trials: station, bench or person, camera, task, scene, recorder. Leaves session.palpa
/// and view-*.png in `folder`.
SessionResult runNeedleSession(const SessionOptions& options, NeedleWorld& world,
                               const std::filesystem::path& folder);

}  // namespace palpa::cli

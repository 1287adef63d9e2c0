#pragma once

#include <filesystem>

#include "apps/cli/palpation_world.h"
#include "apps/cli/session_frame.h"
#include "apps/task_palpation/palpation_task.h"

namespace palpa::cli {

struct PalpationRun : SessionRun {
  std::vector<task_palpation::CompletedPalpation> trials;
};

/// Runs the trials; leaves session.palpa and view-*.png in `folder`.
PalpationRun runPalpation(const SessionOptions& options, const PalpationWorld& world,
                          const std::filesystem::path& folder);

/// trials.csv and report.html; the last lines on standard output say what was written.
void writePalpationOutcome(const SessionOptions& options, const PalpationWorld& world,
                           const PalpationRun& run, const std::filesystem::path& folder);

}  // namespace palpa::cli

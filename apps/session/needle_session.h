#pragma once

#include <filesystem>
#include <vector>

#include "apps/session/needle_world.h"
#include "apps/session/session_facts.h"
#include "apps/session/session_frame.h"
#include "apps/task_needle/needle_scene.h"

namespace palpa::session {

struct SessionResult : SessionRun {
  std::vector<task_needle::CompletedTrial> trials;
};

/// Runs the trials: station, bench or person, camera, task, scene, recorder. Leaves session.palpa
/// and view-*.png in `folder`.
/// `cost`: what it takes of the processor's time, where that is wanted.
SessionResult runNeedleSession(const SessionOptions& options, NeedleWorld& world,
                               const std::filesystem::path& folder, SessionCost* cost = nullptr);

/// trials.csv and report.html beside the evidence, from trials as the session judged them or as
/// they were judged again. `views`: none where the task teaches no way to a vein.
void writeNeedleResults(const ReportHead& head,
                        const std::vector<task_needle::CompletedTrial>& trials,
                        const ReportTail& tail, const Pose& X_DA,
                        std::optional<assess::NeedleViews> views,
                        const std::filesystem::path& evidence);

/// The same of a session that has just ended and, for recorded pictures, registration.csv; then the
/// last lines on standard output say what was written.
void writeOutcome(const SessionOptions& options, const NeedleWorld& world,
                  const SessionResult& result, const std::filesystem::path& folder);

/// An expert's trial to watch before one's own: recorded on the virtual bench (labelled simulated),
/// then played back in the window at its own speed, from the record alone. Enter or Escape ends it.
void showDemonstration(const SessionOptions& options, NeedleWorld& world,
                       const std::filesystem::path& folder);

}  // namespace palpa::session

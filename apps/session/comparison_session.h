#pragma once

#include <filesystem>

#include "apps/session/session_facts.h"
#include "apps/session/session_frame.h"
#include "apps/task_comparison/comparison_task.h"

namespace palpa::session {

/// Everything a comparison session rests on, read and checked before anything starts. Immovable:
/// parts refer to each other.
struct SqueezeWorld {
  explicit SqueezeWorld(const SessionOptions& options);  ///< throws UsageError / Error
  SqueezeWorld(const SqueezeWorld&) = delete;
  SqueezeWorld& operator=(const SqueezeWorld&) = delete;

  station::Station station;
  task_comparison::ComparisonSettings task;
  anatomy::Patient object;  ///< as it is shown
  /// its middle at rest, x from the second tool to the first; as shown
  Pose X_WO = Pose::Identity(), X_WA = Pose::Identity();

  haptics::PairConfig pairConfig(const SessionOptions& options) const;
  SessionDevices::Hands hands(const SessionOptions& options) const;
  ReportHead head(const SessionOptions& options) const;
  record::SessionInfo info(const SessionOptions& options) const;
};

struct ComparisonRun : SessionRun {
  std::vector<task_comparison::CompletedComparison> trials;
};

/// Runs the trials; leaves session.palpa and view-*.png in `folder`.
ComparisonRun runComparison(const SessionOptions& options, const SqueezeWorld& world,
                      const std::filesystem::path& folder);

/// trials.csv and report.html beside the evidence, from trials as the session judged them or as
/// they were judged again.
void writeComparisonResults(const ReportHead& head,
                         const std::vector<task_comparison::CompletedComparison>& trials,
                         const ReportTail& tail, const std::filesystem::path& evidence);

/// The same of a session that has just ended; the last lines on standard output say what was
/// written.
void writeComparisonOutcome(const SessionOptions& options, const SqueezeWorld& world,
                         const ComparisonRun& run, const std::filesystem::path& folder);

}  // namespace palpa::session

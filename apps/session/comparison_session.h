#pragma once

#include <filesystem>
#include <optional>

#include "apps/session/session_facts.h"
#include "apps/session/session_frame.h"
#include "apps/task_comparison/comparison_task.h"
#include "apps/training/engine.h"

namespace palpa::session {

/// Everything a comparison session rests on, read and checked before anything starts: two tools
/// that hold an object (engine squeeze), or one that strokes over a block (friction). Immovable:
/// parts refer to each other.
struct ComparisonWorld {
  /// Throws UsageError / Error.
  ComparisonWorld(const SessionOptions& options, training::Engine engine);
  ComparisonWorld(const ComparisonWorld&) = delete;
  ComparisonWorld& operator=(const ComparisonWorld&) = delete;

  training::Engine engine;
  station::Station station;
  task_comparison::ComparisonSettings task;
  anatomy::Patient object;  ///< as it is shown
  /// what is held: its middle at rest, x from the second tool to the first; what is stroked: the
  /// middle of its top; as shown
  Pose X_WO = Pose::Identity(), X_WA = Pose::Identity();

  int tools() const { return task_comparison::toolsFor(engine); }
  bool onBench() const { return station.device.driver == station::DeviceDriver::bench; }
  bool simulated(const SessionOptions& options) const {
    return isSimulated(options.who) || station.simulated || task.library.simulated;
  }
  /// Of the first tool, or the only one.
  haptics::TickConfig tickConfig(const SessionOptions& options) const;
  std::optional<haptics::PairConfig> pairConfig(const SessionOptions& options) const;
  SessionDevices::Hands hands(const SessionOptions& options) const;
  ReportHead head(const SessionOptions& options) const;
  record::SessionInfo info(const SessionOptions& options) const;

 private:
  SessionDevices::Hands holding(const SessionOptions& options) const;
  SessionDevices::Hands stroking(const SessionOptions& options) const;
};

struct SqueezeWorld : ComparisonWorld {
  explicit SqueezeWorld(const SessionOptions& options)
      : ComparisonWorld(options, training::Engine::squeeze) {}
};
struct FrictionWorld : ComparisonWorld {
  explicit FrictionWorld(const SessionOptions& options)
      : ComparisonWorld(options, training::Engine::friction) {}
};

struct ComparisonRun : SessionRun {
  std::vector<task_comparison::CompletedComparison> trials;
};

/// Runs the trials; leaves session.palpa and view-*.png in `folder`.
ComparisonRun runComparison(const SessionOptions& options, const ComparisonWorld& world,
                            const std::filesystem::path& folder);

/// trials.csv and report.html beside the evidence, from trials as the session judged them or as
/// they were judged again.
void writeComparisonResults(const ReportHead& head,
                            const std::vector<task_comparison::CompletedComparison>& trials,
                            const ReportTail& tail, const std::filesystem::path& evidence);

/// The same of a session that has just ended; the last lines on standard output say what was
/// written.
void writeComparisonOutcome(const SessionOptions& options, const ComparisonWorld& world,
                            const ComparisonRun& run, const std::filesystem::path& folder);

}  // namespace palpa::session

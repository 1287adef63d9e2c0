#pragma once

#include <filesystem>

#include "apps/session/session_facts.h"
#include "apps/session/session_frame.h"
#include "apps/task_pulse/pulse_task.h"

namespace palpa::session {

/// Everything a session with a pulse rests on, read and checked before anything starts. Immovable:
/// parts refer to each other.
struct PulseWorld {
  /// Throws UsageError / Error.
  explicit PulseWorld(const SessionOptions& options);
  PulseWorld(const PulseWorld&) = delete;
  PulseWorld& operator=(const PulseWorld&) = delete;

  station::Station station;
  task_pulse::PulseSettings task;
  anatomy::Patient object;  ///< as it is shown
  Pose X_WA = Pose::Identity();

  bool onBench() const { return station.device.driver == station::DeviceDriver::bench; }
  bool simulated(const SessionOptions& options) const {
    return isSimulated(options.who) || station.simulated || task.library.simulated;
  }
  haptics::TickConfig tickConfig(const SessionOptions& options) const;
  SessionDevices::Hands hands(const SessionOptions& options) const;
  ReportHead head(const SessionOptions& options) const;
  record::SessionInfo info(const SessionOptions& options) const;
};

struct PulseRun : SessionRun {
  std::vector<task_pulse::CompletedPulse> trials;
};

/// Runs the trials; leaves session.palpa and view-*.png in `folder`.
PulseRun runPulse(const SessionOptions& options, const PulseWorld& world,
                  const std::filesystem::path& folder);

/// trials.csv and report.html beside the evidence, from trials as the session judged them or as
/// they were judged again.
void writePulseResults(const ReportHead& head,
                       const std::vector<task_pulse::CompletedPulse>& trials,
                       const assess::PulseRules& rules, const ReportTail& tail,
                       const std::filesystem::path& evidence);

/// The same of a session that has just ended; the last lines on standard output say what was
/// written.
void writePulseOutcome(const SessionOptions& options, const PulseWorld& world, const PulseRun& run,
                       const std::filesystem::path& folder);

}  // namespace palpa::session

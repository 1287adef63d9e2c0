#pragma once

#include <filesystem>
#include <optional>

#include "anatomy/parametric/phantoms.h"
#include "apps/record/session_file.h"
#include "apps/session/session_devices.h"
#include "apps/session/session_facts.h"
#include "apps/session/session_frame.h"
#include "apps/session/session_options.h"
#include "apps/station/station_file.h"
#include "apps/station/taken_away.h"
#include "apps/task_palpation/palpation_file.h"
#include "apps/task_palpation/palpation_task.h"

namespace palpa::session {

/// Everything a palpation session rests on, read and checked before anything starts. Immovable:
/// parts refer to each other.
struct PalpationWorld {
  explicit PalpationWorld(const SessionOptions& options);  ///< throws UsageError / Error
  PalpationWorld(const PalpationWorld&) = delete;
  PalpationWorld& operator=(const PalpationWorld&) = delete;

  station::Station station;
  task_palpation::PalpationSettings task;
  anatomy::Patient phantom;  ///< as it is shown
  Pose X_WA = Pose::Identity();

  bool simulated(const SessionOptions& options) const {
    return isSimulated(options.who) || station.simulated || task.library.simulated;
  }
  bool onBench() const { return station.device.driver == station::DeviceDriver::bench; }
  /// How much of the lump that lies in the phantom this device may take away, where one does.
  station::TakenLimit takenLimit(double rate_Hz) const;
  /// The same in words, what is steadied, too: said before anything starts, and in the report.
  std::vector<report::Fact> takenFacts(const SessionOptions& options) const;
  /// That whoever palpates has a device for each finger. Throws UsageError.
  void checkFingers(const SessionOptions& options) const;
  haptics::TickConfig tickConfig(const SessionOptions& options) const;
  /// Of two fingers; empty: one.
  std::optional<haptics::PairConfig> pairConfig(const SessionOptions& options) const;
  /// Who may hold the tool: on the bench's silicone a simulated person, or one with a mouse, who
  /// sees what is felt there.
  SessionDevices::Hands hands(const SessionOptions& options) const;
  /// Of what is felt, as it is drawn; empty: it is not.
  std::optional<scene::SurfaceMap> shownMap(const SessionOptions& options) const;
  record::SessionInfo info(const SessionOptions& options) const;
  ReportHead head(const SessionOptions& options) const;
  /// What deep is here, and on a patient where that is known; empty: the same.
  std::string forceNote() const;
};

struct PalpationRun : SessionRun {
  std::vector<task_palpation::CompletedPalpation> trials;
};

/// Runs the trials; leaves session.palpa and view-*.png in `folder`.
PalpationRun runPalpation(const SessionOptions& options, const PalpationWorld& world,
                          const std::filesystem::path& folder);

/// trials.csv and report.html beside the evidence, from trials as the session judged them or as
/// they were judged again.
void writePalpationResults(const ReportHead& head,
                           const std::vector<task_palpation::CompletedPalpation>& trials,
                           const task_palpation::Scoring& scoring, const ReportTail& tail,
                           const std::filesystem::path& evidence);

/// The same of a session that has just ended; the last lines on standard output say what was
/// written.
void writePalpationOutcome(const SessionOptions& options, const PalpationWorld& world,
                           const PalpationRun& run, const std::filesystem::path& folder);

}  // namespace palpa::session

#pragma once

#include <filesystem>

#include "apps/session/session_facts.h"
#include "apps/session/session_frame.h"
#include "apps/task_search/search_task.h"

namespace palpa::session {

/// Everything a search session rests on, read and checked before anything starts. Immovable: parts
/// refer to each other.
struct SearchWorld {
  explicit SearchWorld(const SessionOptions& options);  ///< throws UsageError / Error
  SearchWorld(const SearchWorld&) = delete;
  SearchWorld& operator=(const SearchWorld&) = delete;

  station::Station station;
  task_search::SearchSettings task;
  haptics::FloorRendering rendering;  ///< on this station
  anatomy::Patient plate;             ///< as it is shown, magnified
  Pose X_WA = Pose::Identity(), X_AF = Pose::Identity();
  std::vector<task_search::Episode> episodes;

  bool onBench() const { return station.device.driver == station::DeviceDriver::bench; }
  bool simulated(const SessionOptions& options) const {
    return isSimulated(options.who) || onBench();
  }
  double magnification() const { return task.shown_per_U / rendering.unit; }
  haptics::TickConfig tickConfig(const SessionOptions& options) const;
  SessionDevices::Hands hands(const SessionOptions& options) const;
  ReportHead head(const SessionOptions& options) const;
  record::SessionInfo info(const SessionOptions& options) const;
};

struct SearchRun : SessionRun {
  std::vector<task_search::CompletedSearch> trials;
};

/// Runs the episodes; leaves session.palpa and view-*.png in `folder`.
SearchRun runSearch(const SessionOptions& options, const SearchWorld& world,
                    const std::filesystem::path& folder);

/// trials.csv and report.html beside the evidence, from episodes as the session judged them or as
/// they were judged again.
void writeSearchResults(const ReportHead& head,
                        const std::vector<task_search::CompletedSearch>& trials,
                        const ReportTail& tail, const std::filesystem::path& evidence);

/// The same of a session that has just ended; the last lines on standard output say what was
/// written.
void writeSearchOutcome(const SessionOptions& options, const SearchWorld& world,
                        const SearchRun& run, const std::filesystem::path& folder);

}  // namespace palpa::session

#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/runtime/flight_sink.h"
#include "apps/training/trial_clock.h"
#include "haptics/loop/tick_config.h"
#include "haptics/loop/tick_forces.h"
#include "haptics/loop/tick_state.h"

namespace palpa::record {

/// What a session file says of itself. JSON texts are stored as given.
struct SessionInfo {
  std::string uuid;          ///< made by `create` when empty
  std::string started_utc;   ///< ISO 8601; the one anchor of session time 0
  std::string software;      ///< version
  std::string command;       ///< the command line's meaning, no paths
  std::string session_json;  ///< seed, operator, force feedback, trainee pseudonym, frames, ...
  std::string station_json;
  std::string task_json;
  std::string patient_glb;  ///< the patient file's bytes, so that the evidence stands alone
  std::string expert_path_json;
  haptics::TickConfig tick_config;  ///< of the first device where there are two
  /// of two devices in one tick: every tick is recorded twice, FlightRecord::tool telling which
  std::optional<haptics::PairConfig> pair_config = {};
};

/// Writes `session.palpa`: SQLite, application_id "palp", user_version 1, WAL, one a session. Ticks
/// and keyframes in compressed chunks of 200; every snapshot whole. A killed process leaves a file
/// that opens.
class SessionWriter final : public runtime::FlightSink {
 public:
  SessionWriter(const std::filesystem::path& file, const SessionInfo& info);
  ~SessionWriter() override;  ///< commits and checkpoints

  void beginTrial(const runtime::TrialHeader& header) override;
  void snapshot(const LocalGeometry& geometry) override;
  void tick(const haptics::FlightRecord& record) override;
  void keyframe(std::int64_t tick, const haptics::TickState& state) override;
  void event(const runtime::Event& event) override;
  void endTrial(const runtime::TrialEnd& end) override;
  void commit() override;
  void close();  ///< throws Error when the last commit fails

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

struct RecordedTrial {
  runtime::TrialHeader header;
  runtime::TrialEnd end;  ///< `t_ns` of one that did not end: of the last tick that was recorded
  bool ended = false;     ///< false: the process stopped in the middle

  /// From begin to end, pauses included.
  double length_s() const { return 1e-9 * static_cast<double>(end.t_ns - header.t_ns); }

  /// Whether it had ended before this time; one that the process stopped in has not.
  bool isOver(std::int64_t t_ns) const { return ended && t_ns > end.t_ns; }
};

/// Reads a session file; checks application id, version, chunk sizes. Throws Error.
class SessionReader {
 public:
  explicit SessionReader(const std::filesystem::path& file);
  ~SessionReader();

  const SessionInfo& info() const;
  std::vector<RecordedTrial> trials() const;
  std::vector<runtime::Event> events() const;
  /// Calls `visit` for every tick, in order.
  void ticks(const std::function<void(const haptics::FlightRecord&)>& visit) const;
  void snapshots(const std::function<void(const LocalGeometry&)>& visit) const;
  void keyframes(const std::function<void(std::int64_t, const haptics::TickState&)>& visit) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The time of every trial, by its number, as its replay shows it: one pass over the ticks. (A
/// search is judged from when its handle is let go.) `visit`: is called with each of these ticks in
/// which that time runs. Throws Error.
std::map<int, training::TrialTimes> trialTimes(
    const SessionReader& reader,
    const std::function<void(const haptics::FlightRecord&)>& visit = {});

/// A column of the tick table: its name ends in its unit where it has one; `meaning` says the rest.
/// SI units throughout, so that every number is the recorded one to its last bit.
struct TickColumn {
  std::string name, meaning;
};

/// The dictionary of a session's `exportTicks`, in the order of the columns: one vector for each of
/// its task's augmentations.
std::vector<TickColumn> tickColumns(const SessionInfo& info);

/// Takes a recorded tick, and what its force is made of: null where that is not known.
using VisitTick =
    std::function<void(const haptics::FlightRecord& tick, const haptics::TickForces* forces)>;
/// Passes every tick of a session on, in order.
using TickSource = std::function<void(const VisitTick& visit)>;

/// Every tick as one line of comma-separated values under a header line; for statistics programs.
/// The record has not what a force is made of: those columns are empty where the source does not
/// say it. Written beside, then renamed. Throws Error.
void exportTicks(const SessionReader& reader, const TickSource& ticks,
                 const std::filesystem::path& file);

/// The laws of a session as JSON, SI units: limits, the task's parts and augmentations with their
/// figures; of a search how its floor is rendered; where something real was touched what was added
/// to it, by the equations of haptics/modulation, with the lumps of its trials. With the ticks
/// every force can be computed again.
std::string lawsJson(const SessionReader& reader);

/// What a walk calls, trial by trial in the order of their numbers. All three must be given.
struct TrialVisitor {
  std::function<void(const RecordedTrial&)> begin;
  std::function<void(const haptics::FlightRecord&)> tick;
  std::function<void(const RecordedTrial&)> finish;
};

/// One pass over the record: of each trial `begin`, `tick` with its ticks, `finish`. A trial lasts
/// until its end or the first tick that bears a higher number; ticks that bear a lower one, as
/// before the first trial, are passed on with the trial that comes next. A trial without ticks is
/// begun and finished as well. `trials`: as the reader gives them. Throws what reader and visitor
/// throw.
void walkTrials(const SessionReader& reader, const std::vector<RecordedTrial>& trials,
                const TrialVisitor& visitor);

}  // namespace palpa::record

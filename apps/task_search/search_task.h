#pragma once

#include <array>
#include <vector>

#include "apps/assess/dose_counter.h"
#include "apps/assess/search/search_trial.h"
#include "apps/task_search/floors.h"
#include "apps/task_search/search_file.h"
#include "apps/training/trial_clock.h"
#include "apps/training/trial_words.h"
#include "apps/trial/trial_task.h"

namespace palpa::task_search {

/// Makes of the recorded ticks what an episode is judged by; the same for a session and for its
/// replay. The time runs from when the handle is let go. Dwelling: in contact, within a pit's
/// radius of its middle.
class SearchListener {
 public:
  /// `plan`: the session's, as the loop runs with it.
  SearchListener(const SearchSettings& task, const haptics::AugmentationPlan& plan);
  void begin(std::uint32_t trial);
  void add(const haptics::FlightRecord& record, const Vec3& p_DT);

  bool released() const { return released_; }  ///< the handle has been let go
  double seconds() const { return clock_.seconds(); }
  /// Element where the probe has stayed long enough; -1: none yet
  int chosen() const { return chosen_; }
  std::uint8_t subtasks() const { return subtasks_; }  ///< bits, of the last tick
  /// What was heard, into a trial's facts.
  assess::SearchTrial observed(assess::SearchTrial facts) const;

 private:
  const SearchSettings* task_;
  haptics::AugmentationPlan plan_;
  std::uint32_t trial_ = 0;
  training::TrialClock clock_;  ///< the holding left out
  bool released_ = false;
  Vec3 p_last_ = Vec3::Zero();
  double path_ = 0, peak_N_ = 0, force_Ns_ = 0, contact_s_ = 0, dwell_s_ = 0;
  int dwells_ = -1, chosen_ = -1;
  std::uint8_t subtasks_ = 0;
  std::array<double, 3> visited_{};
  assess::DoseCounter doses_;
};

struct CompletedSearch {
  assess::SearchTrial trial;
  std::string reason;  ///< why aborted or void
};

/// What the task tells the scene.
struct SearchStatus : trial::TrialStatus {
  assess::SearchMode mode = assess::SearchMode::real;
  std::string block;
  bool held = false;  ///< the handle is still held at its start
};

struct SearchChannels : trial::Channels {
  explicit SearchChannels(runtime::TimeMode mode) : status_to_scene(mode) {}
  runtime::StateChannel<SearchStatus> status_to_scene;
};

/// What a search's episodes are made of.
struct SearchTaskSetup {
  const SearchSettings& settings;
  haptics::TickConfig tick;
  bool simulated = false, automatic = true, force_feedback = true;
  bool waits = false;      ///< for a floor that is being made: in virtual time
  std::string not_scored;  ///< why; empty: scored
  const std::vector<Episode>& episodes;
  std::vector<runtime::BoardPlace> places;
  /// of the episodes, where nothing speaks against it
  training::Role role = training::Role::scored;
};

/// The search's episodes: the handle is held over the middle, let go, and the episode ends when the
/// probe has stayed in an element's pit.
class SearchTask final : public trial::TrialTask {
 public:
  SearchTask(const SearchTaskSetup& setup, Floors& floors, runtime::Bus& bus,
             SearchChannels& channels, runtime::Executive& executive);

  const std::vector<CompletedSearch>& completed() const { return completed_; }

 private:
  std::string notReady(const haptics::FlightRecord& last) const override;
  runtime::TrialHeader begin(std::int64_t now_ns) override;
  Conclusion conclude(training::Outcome outcome, const std::string& reason) override;
  void judge(const haptics::FlightRecord& record, std::int64_t now_ns) override;
  void command(haptics::TickCommands& commands) const override;
  void publishStatus(std::int64_t now_ns) override;
  std::string doing() const override { return "Stay in the middle of the rough one to choose it"; }
  void letGo(const haptics::FlightRecord& record, std::int64_t now_ns);
  const Episode& episode() const {
    return setup_.episodes[static_cast<std::size_t>(status().trial - 1)];
  }

  SearchTaskSetup setup_;
  Floors& floors_;
  SearchChannels& channels_;
  SearchListener listener_;
  bool held_ = false;
  std::int64_t began_ns_ = 0;
  SearchStatus shown_;
  std::vector<CompletedSearch> completed_;
};

/// Where the tip is, in D, by a reading of a device that turns.
Vec3 tipOf(const haptics::TickConfig& config, const haptics::DeviceReading& reading);
/// What the loop is told of an episode.
void commandLoop(const Episode& episode, haptics::TickCommands* commands);
/// What a trial was, from its facts and what was heard of it; the same for a session and for its
/// replay.
assess::SearchTrial judged(assess::SearchTrial facts, const Episode& episode,
                           const SearchListener& listener);
/// What is recorded of it.
std::string scoreJson(const assess::SearchTrial& trial);

}  // namespace palpa::task_search

#pragma once

#include <array>
#include <vector>

#include "apps/task_comparison/comparison_file.h"
#include "apps/training/trial_words.h"
#include "apps/trial/trial_status.h"
#include "apps/trial/trial_task.h"
#include "haptics/flight_record.h"

namespace palpa::task_comparison {

/// Makes of the recorded ticks of both tools what a comparison is judged by; the same for a session
/// and for its replay. Held: both sensors feel more than `touch` for 0.1 s or longer. Squeezing:
/// the smaller of the forces that both fingers hold against, the real thing's and the device's
/// together.
class ComparisonListener {
 public:
  explicit ComparisonListener(double touch) : touch_(touch) {}
  void begin(std::uint32_t trial, const Comparison& comparison);
  /// Both tools' records of a tick, the first one's first. Counts while the trial is on and force
  /// may be rendered.
  void add(const haptics::FlightRecord& record);

  double seconds() const { return seconds_; }  ///< of the trial, pauses left out
  double peak() const { return peak_; }        ///< N
  double now_N() const { return now_N_; }      ///< squeezing force of the last tick
  bool held() const { return held_s_ > 0; }    ///< both fingers touch
  const std::array<int, 2>& grips() const { return grips_; }
  int thing(const haptics::TickCommands& commands)
      const;  ///< which of the two is felt by these commands: 0 or 1

 private:
  double touch_;
  std::uint32_t trial_ = 0;
  Comparison comparison_;
  std::int64_t last_ns_ = -1;
  haptics::FlightRecord first_;  ///< of the first tool, in this tick
  double seconds_ = 0, peak_ = 0, now_N_ = 0, held_s_ = 0;
  std::array<int, 2> grips_{0, 0};
};

/// What the loop is told of one of the two things.
void commandLoop(const Comparison& comparison, int thing, haptics::TickCommands* commands);

struct CompletedComparison {
  assess::ComparisonTrial trial;
  std::string reason;  ///< why aborted or void
};

/// What the task tells the scene.
struct ComparisonStatus : trial::TrialStatus {
  assess::ComparedProperty property = assess::ComparedProperty::stiffness;
  int thing = 0;  ///< 0 or 1: which of the two is felt now
  double squeezed_N = 0;
  bool held = false;
};

struct ComparisonChannels : trial::Channels {
  explicit ComparisonChannels(runtime::TimeMode mode) : status_to_scene(mode) {}
  runtime::StateChannel<ComparisonStatus> status_to_scene;
};

/// What a comparison's trials are made of.
struct ComparisonTaskSetup {
  const ComparisonSettings& settings;
  bool simulated = false, automatic = true, force_feedback = true;
  std::string not_scored;  ///< why; empty: scored
  std::uint64_t seed = 1;
  std::vector<Comparison> comparisons;
  std::vector<runtime::BoardPlace> places;
  /// of the comparisons, where nothing speaks against it
  training::Role role = training::Role::scored;
};

/// The comparison's trials: two things, one after the other and as often as one likes ("done": the
/// other one, once the object is let go); then which has more ("grade": 1 or 2).
class ComparisonTask final : public trial::TrialTask {
 public:
  ComparisonTask(const ComparisonTaskSetup& setup, runtime::Bus& bus, ComparisonChannels& channels,
              runtime::Executive& executive);

  const std::vector<CompletedComparison>& completed() const { return completed_; }

 private:
  std::string notReady(const haptics::FlightRecord& last) const override;
  runtime::TrialHeader begin(std::int64_t now_ns) override;
  Conclusion conclude(training::Outcome outcome, const std::string& reason) override;
  void watch(const haptics::FlightRecord& record) override { last_of_[record.tool & 1] = record; }
  void judge(const haptics::FlightRecord& record, std::int64_t now_ns) override;
  void command(haptics::TickCommands& commands) const override;
  void publishStatus(std::int64_t now_ns) override;
  void receive(const trial::UserRequest& request, std::int64_t now_ns) override;
  void otherThing(std::int64_t now_ns);
  void answer(int said, std::int64_t now_ns);
  const Comparison& comparison() const {
    return setup_.comparisons[static_cast<std::size_t>(status().trial - 1)];
  }

  ComparisonTaskSetup setup_;
  ComparisonChannels& channels_;
  ComparisonListener listener_;
  std::array<haptics::FlightRecord, 2> last_of_;
  int thing_ = 0, said_ = 0;
  ComparisonStatus shown_;
  std::vector<CompletedComparison> completed_;
};

/// What a trial was, from its facts and what was heard of it; the same for a session and for its
/// replay.
assess::ComparisonTrial judged(assess::ComparisonTrial facts, const Comparison& comparison,
                            const ComparisonListener& listener, int said);
/// What is recorded of it.
std::string scoreJson(const assess::ComparisonTrial& trial);

}  // namespace palpa::task_comparison

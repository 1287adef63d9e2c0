#pragma once

#include <array>
#include <vector>

#include "apps/task_comparison/comparison_file.h"
#include "apps/training/engine.h"
#include "apps/training/trial_clock.h"
#include "apps/training/trial_words.h"
#include "apps/trial/trial_status.h"
#include "apps/trial/trial_task.h"
#include "haptics/flight_record.h"

namespace palpa::task_comparison {

/// Two tools hold something, one strokes over something.
inline int toolsFor(training::Engine engine) { return engine == training::Engine::squeeze ? 2 : 1; }

/// Makes of the recorded ticks of one tool or two what a comparison is judged by; the same for a
/// session and for its replay. Touched: every sensor feels more than `touch` for 0.1 s or longer.
/// The force that counts is the real thing's and the device's together; of two tools the smaller
/// one, which is what both fingers hold against.
class ComparisonListener {
 public:
  ComparisonListener(double touch, int tools) : touch_(touch), tools_(tools) {}
  void begin(std::uint32_t trial, const Comparison& comparison);
  /// Of two tools both records of a tick, the first one's first. Counts while the trial is on and
  /// force may be rendered.
  void add(const haptics::FlightRecord& record);

  double seconds() const { return clock_.seconds(); }           ///< of the trial, pauses left out
  double peak() const { return peak_; }                         ///< N
  double now_N() const { return now_N_; }                       ///< of the last tick
  bool touching() const { return touch_s_ > 0; }                ///< every tool does
  const std::vector<int>& touches() const { return touches_; }  ///< of each thing
  bool touchedAll() const;
  int allTouches() const;
  /// Which of the things is felt by these commands: 0, 1, ...
  int thing(const haptics::TickCommands& commands) const;

 private:
  double touch_;
  int tools_;
  std::uint32_t trial_ = 0;
  Comparison comparison_;
  training::TrialClock clock_;
  haptics::FlightRecord first_;  ///< of the first tool, in this tick
  double peak_ = 0, now_N_ = 0, touch_s_ = 0;
  std::vector<int> touches_{0, 0};
};

/// What the loop is told of one of the things.
void commandLoop(const Comparison& comparison, int thing, haptics::TickCommands* commands);

/// What was said in a trial.
struct Answer {
  int more = 0;            ///< of two, which has more: 1 or 2; 0: nothing was said
  std::vector<int> order;  ///< of more, their numbers, least first

  /// From the event of it in the record; each number of an order is an event.
  void add(double value, bool sorting);
};

struct CompletedComparison {
  assess::ComparisonTrial trial;
  std::string reason;  ///< why aborted or void
};

/// What the task tells the scene.
struct ComparisonStatus : trial::TrialStatus {
  assess::ComparedProperty property = assess::ComparedProperty::stiffness;
  int thing = 0, things = 2;  ///< 0, 1, ...: which of them is felt now
  double force_N = 0;
  bool touching = false;
  std::vector<int> order;  ///< as far as it was said
};

struct ComparisonChannels : trial::Channels {
  explicit ComparisonChannels(runtime::TimeMode mode) : status_to_scene(mode) {}
  runtime::StateChannel<ComparisonStatus> status_to_scene;
};

/// What a comparison's trials are made of.
struct ComparisonTaskSetup {
  const ComparisonSettings& settings;
  int tools = 2;
  bool simulated = false, automatic = true, force_feedback = true;
  std::string not_scored;  ///< why; empty: scored
  std::uint64_t seed = 1;
  std::vector<Comparison> comparisons;
  std::vector<runtime::BoardPlace> places;
  /// of the comparisons, where nothing speaks against it
  training::Role role = training::Role::scored;
};

/// The comparison's trials: things, one after the other in a circle and as often as one likes
/// ("done": the next one, once this one is let go). Of two then which has more ("grade": 1 or 2);
/// of more their order, one number after the other ("choose").
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
  void nextThing(std::int64_t now_ns);
  void answer(int said, std::int64_t now_ns);
  void putInOrder(int number, std::int64_t now_ns);
  bool mayAnswer();
  const Comparison& comparison() const {
    return setup_.comparisons[static_cast<std::size_t>(status().trial - 1)];
  }
  int things() const { return static_cast<int>(comparison().factors.size()); }
  bool sorting() const { return things() > 2; }

  ComparisonTaskSetup setup_;
  ComparisonChannels& channels_;
  ComparisonListener listener_;
  std::array<haptics::FlightRecord, 2> last_of_;
  int thing_ = 0;
  Answer said_;
  ComparisonStatus shown_;
  std::vector<CompletedComparison> completed_;
};

/// What a trial was, from its facts and what was heard of it; the same for a session and for its
/// replay.
assess::ComparisonTrial judged(assess::ComparisonTrial facts, const Comparison& comparison,
                               const ComparisonListener& listener, const Answer& said);
/// What is recorded of it.
std::string scoreJson(const assess::ComparisonTrial& trial);

}  // namespace palpa::task_comparison

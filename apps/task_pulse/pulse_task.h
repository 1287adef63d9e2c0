#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/task_pulse/pulse_file.h"
#include "apps/training/trial_clock.h"
#include "apps/training/trial_words.h"
#include "apps/trial/trial_status.h"
#include "apps/trial/trial_task.h"
#include "haptics/loop/tick_config.h"

namespace palpa::task_pulse {

/// Parts of a trial, in their order; in every tick's commands.
enum class PulsePart : std::uint8_t { none, find, count, number, rhythm };

PulsePart partIn(const haptics::TickCommands& commands);

/// Makes of the recorded ticks what an examination of a pulse is judged by; the same for a session
/// and for its replay. Place: the lowest point of the round tip. How hard it is pressed: what the
/// hand has to hold against along P's z, the real thing and the device together. A mark: button 1
/// goes down while the surface is touched, in the part `find`; the last one counts. Delivered: the
/// beats whose waves begin while it is counted.
class PulseListener {
 public:
  static constexpr std::uint32_t kMark = 1;  ///< bit of DeviceReading::buttons
  PulseListener(const haptics::TickConfig& config, const assess::PulseRules& rules);

  void begin(std::uint32_t trial);  ///< everything so far is forgotten
  /// Counts while the trial is on and force may be rendered.
  void add(const haptics::FlightRecord& record);

  double seconds() const { return clock_.seconds(); }  ///< of the trial, pauses left out
  double countedSeconds() const { return counted_s_; }
  double now_N() const { return now_N_; }
  bool touching() const { return now_N_ >= rules_.touch_N; }
  const std::optional<Vec3>& mark_P() const { return mark_P_; }
  int marks() const { return marks_; }
  /// Into a trial's facts: where and when it was marked, what was delivered, how it was pressed.
  void into(const PulseCase& patient, assess::PulseTrial* trial) const;

 private:
  void watchMark(const haptics::FlightRecord& record, PulsePart part);
  void countBeats(const haptics::FlightRecord& record, std::int64_t since_ns, double dt);

  Pose X_PD_, X_ET_;
  double radius_, closed_at_;
  assess::PulseRules rules_;
  std::uint32_t trial_ = 0;
  training::TrialClock clock_;
  std::int64_t last_ns_ = -1;
  bool pressed_ = true;  ///< a button that is down already marks nothing
  double counted_s_ = 0, shut_s_ = 0, off_s_ = 0, peak_N_ = 0, now_N_ = 0;
  int marks_ = 0, delivered_ = 0;
  std::optional<Vec3> mark_P_;
  double mark_s_ = 0;
};

/// What was said in a trial, in its order: first a number of beats, then a rhythm, 1 to 3.
struct PulseAnswer {
  std::optional<int> counted;
  std::optional<assess::PulseRhythm> rhythm;
  /// From the event of it in the record.
  void add(double value);
};

struct CompletedPulse {
  assess::PulseTrial trial;
  std::string reason;  ///< why aborted or void
};

/// What the task tells the scene.
struct PulseStatus : trial::TrialStatus {
  PulsePart part = PulsePart::none;
  std::string artery;
  std::string typed;  ///< of the number
  double count_left_s = 0;
  double force_N = 0;
  std::optional<Vec3> mark_P;
};

struct PulseChannels : trial::Channels {
  explicit PulseChannels(runtime::TimeMode mode) : status_to_scene(mode) {}
  runtime::StateChannel<PulseStatus> status_to_scene;
};

/// What a pulse task's trials are made of.
struct PulseTaskSetup {
  const PulseSettings& settings;
  haptics::TickConfig tick;
  bool simulated = false, automatic = true, force_feedback = true;
  std::string not_scored;  ///< why; empty: scored
  std::uint64_t seed = 1;
  std::vector<PulseCase> cases;
  std::vector<runtime::BoardPlace> places;
  training::Role role = training::Role::scored;  ///< where nothing speaks against it
};

/// The trials: find it and mark it with the button ("done": the count begins); count, which ends by
/// itself; the number ("choose": a digit, then "done"; or all of it); the rhythm ("choose": 1 to
/// 3).
class PulseTask final : public trial::TrialTask {
 public:
  PulseTask(const PulseTaskSetup& setup, runtime::Bus& bus, PulseChannels& channels,
            runtime::Executive& executive);

  const std::vector<CompletedPulse>& completed() const { return completed_; }

 private:
  std::string notReady(const haptics::FlightRecord& last) const override;
  runtime::TrialHeader begin(std::int64_t now_ns) override;
  Conclusion conclude(training::Outcome outcome, const std::string& reason) override;
  void judge(const haptics::FlightRecord& record, std::int64_t now_ns) override;
  void command(haptics::TickCommands& commands) const override;
  void publishStatus(std::int64_t now_ns) override;
  void receive(const trial::UserRequest& request, std::int64_t now_ns) override;
  void startCount(std::int64_t now_ns);
  void type(const std::string& digits, std::int64_t now_ns);
  void sayNumber(std::int64_t now_ns);
  void sayRhythm(int number, std::int64_t now_ns);
  const PulseCase& patient() const {
    return setup_.cases[static_cast<std::size_t>(status().trial - 1)];
  }

  PulseTaskSetup setup_;
  PulseChannels& channels_;
  PulseListener listener_;
  std::optional<BeatSchedule> heart_;
  std::array<haptics::PulseBeat, haptics::kMostBeats> beats_{};
  PulsePart part_ = PulsePart::none;
  std::string typed_;
  PulseAnswer said_;
  PulseStatus shown_;
  std::vector<CompletedPulse> completed_;
};

/// What a trial was, from its facts and what was heard of it; the same for a session and for its
/// replay.
assess::PulseTrial judged(assess::PulseTrial facts, const PulseCase& patient,
                          const PulseListener& listener, const PulseAnswer& said);
/// What is recorded of it.
std::string scoreJson(const assess::PulseTrial& trial, const assess::PulseRules& rules);

}  // namespace palpa::task_pulse

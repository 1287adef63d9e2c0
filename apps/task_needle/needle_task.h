#pragma once

#include <array>
#include <utility>
#include <vector>

#include "anatomy/query/surface_query.h"
#include "apps/assess/dose_counter.h"
#include "apps/assess/needle/aspiration.h"
#include "apps/assess/needle/phases.h"
#include "apps/assess/needle/trial_sampler.h"
#include "apps/task_needle/task_file.h"
#include "apps/training/fading_support.h"
#include "apps/training/trial_words.h"
#include "apps/trial/trial_status.h"
#include "apps/trial/trial_task.h"
#include "calibration/expert_path.h"

namespace palpa::task_needle {

/// What the task tells the scene: for the HUD, the syringe, the pictures.
struct TaskStatus : trial::TrialStatus {
  assess::ProcedurePhase phase = assess::ProcedurePhase::approach;
  std::string step;               ///< what is being done, in words
  double plunger = 0, blood = 0;  ///< drawn, filled; fractions of the syringe
  Tissue flows = Tissue::air;     ///< whose blood or air enters the syringe now
  Tissue holds = Tissue::air;     ///< whose blood is in it
  bool asked = false;             ///< what is aspirated: vein, artery or neither
  double answer_within_s = 0;     ///< so long it is waited for; 0: not known
};

struct TrialPlan {
  training::Role role = training::Role::scored;
  std::uint64_t seed = 1;
  bool force_feedback = true;
  bool augmented = false;         ///< the task's augmentations add force
  double puncture_force_N = 1.5;  ///< of the skin
  /// of the walls' median peaks
  std::array<float, kOrganCount> wall_scale = haptics::TickCommands{}.wall_scale;
  int most_passes = 0;  ///< of the needle: the next one ends the trial; 0: no limit
};

/// What the cues that fade refer to, in the device's frame: the line that leads to the vein, and
/// what is kept out of. Nothing of it is commanded where such cues are not felt.
struct NeedleFixtures {
  Packed3 line_p_D{}, line_a_D{};  ///< m; unit
  std::array<haptics::KeptOut, haptics::kMostKeptOut> kept_out{};
};

/// What stays of a trial: its ticks are in the evidence.
struct CompletedTrial {
  assess::TrialAssessment assessment;
  std::string reason;  ///< why aborted or void
};

/// Task channels beside the bus: one writer, one reader each.
struct TaskChannels : trial::Channels {
  explicit TaskChannels(runtime::TimeMode mode) : status_to_scene(mode) {}
  runtime::StateChannel<TaskStatus> status_to_scene;
};

/// What a needle's trials are made of.
struct NeedleTaskSetup {
  const anatomy::Patient& patient;
  const anatomy::SurfaceQuery& query;
  const TaskSettings& settings;
  /// of this patient; null: not scored against a path (experts record one)
  const calibration::TaughtPath* taught_path;
  Pose X_AD = Pose::Identity();
  PackedPose X_ET;
  bool simulated = false;
  bool automatic = true;            ///< starts trials by itself
  std::string calibration_problem;  ///< not empty: sessions are "not scored"
  std::vector<TrialPlan> plan;
  std::vector<runtime::BoardPlace> places;  ///< of the boards besides the table's
  haptics::AugmentationPlan augmentations;  ///< as on this device
  NeedleFixtures fixtures;
  /// Bits of DeviceReading::buttons that say vein, artery, neither; 0: the device has none for it.
  std::array<std::uint32_t, 3> answers{};
  /// Of a recorded hand: what was said, and when in the session; ns.
  std::vector<std::pair<std::int64_t, assess::Taken>> said;
};

/// The needle's trials: phases, success, time limit, score.
class NeedleTask final : public trial::TrialTask {
 public:
  NeedleTask(const NeedleTaskSetup& setup, runtime::Bus& bus, TaskChannels& channels,
             runtime::Executive& executive);

  std::int64_t step(std::int64_t now_ns) override;
  const std::vector<CompletedTrial>& completed() const { return completed_; }

 private:
  std::string notReady(const haptics::FlightRecord& last) const override;
  runtime::TrialHeader begin(std::int64_t now_ns) override;
  Conclusion conclude(training::Outcome outcome, const std::string& reason) override;
  void judge(const haptics::FlightRecord& record, std::int64_t now_ns) override;
  void command(haptics::TickCommands& commands) const override;
  void publishStatus(std::int64_t now_ns) override;
  void receive(const trial::UserRequest& request, std::int64_t now_ns) override;
  void aspirate(const assess::TrialSample& sample, double dt, std::int64_t now_ns);
  void answerItself(std::int64_t now_ns);
  void take(assess::Taken taken, std::int64_t now_ns);
  void hearButtons(const haptics::FlightRecord& record, std::int64_t now_ns);
  void announce(const assess::TrialSample& sample, std::int64_t now_ns);
  const TrialPlan& plan() const {
    return setup_.plan[static_cast<std::size_t>(status().trial - 1)];
  }
  void support(std::int64_t now_ns);

  NeedleTaskSetup setup_;
  TaskChannels& channels_;
  assess::TrialSampler sampler_;
  assess::PhaseDetector phases_;
  assess::PassCounter passes_;
  GoalTrial goal_;    ///< where the task has a goal of its own
  TaskStatus shown_;  ///< its own part; the base is filled in when it is published
  std::vector<assess::TrialSample> samples_;
  assess::TrialDoses doses_;
  std::vector<CompletedTrial> completed_;
  training::FadingSupport support_;
  double supported_ = 0;  ///< share of what fades in this trial
  assess::Syringe syringe_;
  assess::AspirationQuestion question_;
  std::uint32_t buttons_ = 0;                    ///< of the last tick
  std::size_t said_ = 0;                         ///< of the setup's, so many
  std::array<double, kOrganCount> touched_s_{};  ///< trial time of the last contact, by Organ
  bool entered_vein_ = false;
};

/// A trial of a task without an expert path, judged; the same for a session and for its replay.
/// `goal`: has seen all its samples; null: the task has none.
assess::TrialAssessment judgedWithoutPath(const assess::TrialFacts& facts, const GoalTrial* goal,
                                          const std::vector<assess::TrialSample>& samples,
                                          const assess::ScoringRules& rules);

}  // namespace palpa::task_needle

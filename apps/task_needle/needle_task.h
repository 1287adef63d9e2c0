#pragma once

#include <array>
#include <vector>

#include "anatomy/surface_query.h"
#include "apps/assess/trial_sampler.h"
#include "apps/runtime/activity.h"
#include "apps/runtime/board_places.h"
#include "apps/runtime/bus.h"
#include "apps/runtime/camera_words.h"
#include "apps/runtime/executive.h"
#include "apps/task_needle/task_file.h"
#include "apps/task_needle/task_status.h"
#include "calibration/expert_path.h"

namespace palpa::task_needle {

struct TrialPlan {
  std::string role = "scored";
  std::uint64_t seed = 1;
  bool force_feedback = true;
  double puncture_force_N = 1.5;                       ///< of the skin
  std::array<float, kOrganCount> wall_scale = haptics::TickCommands{}.wall_scale;   ///< of the walls' median peaks
};

struct CompletedTrial {
  assess::TrialAssessment assessment;
  std::vector<assess::TrialSample> samples;   ///< every tick of the trial
  std::string reason;                         ///< why aborted or void
};

/// Task channels beside the bus: one writer, one reader each.
struct TaskChannels {
  explicit TaskChannels(runtime::TimeMode mode) : status_to_scene(mode) {}
  runtime::StateChannel<TaskStatus> status_to_scene;
  runtime::EventQueue<PictureRequest> pictures_to_scene{64};
  runtime::EventQueue<UserRequest> requests_to_task{64};   ///< from the scene: keys
  runtime::EventQueue<UserRequest> signals_to_task{4};     ///< from the system: the session shall end
  runtime::EventQueue<UserRequest> operator_to_task{8};    ///< from a simulated operator who gives up
};

/// TASK, 60 Hz: leads through the trials. Ready check, start, phases, success, limits, score; judges by
/// the recorded ticks alone, so that a replay comes to the same verdict.
class NeedleTask final : public runtime::Activity {
 public:
  struct Setup {
    const anatomy::Patient& patient;
    const anatomy::SurfaceQuery& query;
    const TaskSettings& settings;
    const calibration::ExpertPath* expert_path;   ///< null: not scored against a path (experts record one)
    Pose X_AD = Pose::Identity();
    PackedPose X_ET;
    bool simulated = false;
    bool automatic = true;            ///< starts trials by itself
    std::string calibration_problem;  ///< not empty: sessions are "not scored"
    std::vector<TrialPlan> plan;
    std::vector<runtime::BoardPlace> places;   ///< of the boards besides the table's
  };
  NeedleTask(const Setup& setup, runtime::Bus& bus, TaskChannels& channels,
             runtime::Executive& executive);

  const char* name() const override { return "task"; }
  std::int64_t step(std::int64_t now_ns) override;

  const std::vector<CompletedTrial>& completed() const { return completed_; }
  bool quit() const { return quit_; }
  /// Every "safety" and "device" event and every loss of the camera, in order.
  const std::vector<runtime::Event>& safetyEvents() const { return safety_events_; }
  std::uint64_t lostTicks() const { return bus_.haptic_to_task.overflows(); }

 private:
  void obey(std::int64_t now_ns);
  void obey(const UserRequest& request, std::int64_t now_ns);
  void listen(std::int64_t now_ns);
  void hearDevice();
  void watchCamera(std::int64_t now_ns);
  std::string sightTrouble(const runtime::CameraView* view, std::int64_t now_ns);
  void watchSafety(const haptics::FlightRecord& record);
  void judge(const haptics::FlightRecord& record, std::int64_t now_ns);
  void checkReady(std::int64_t now_ns);
  void startTrial(std::int64_t now_ns);
  void endTrial(const std::string& outcome, const std::string& reason, std::int64_t now_ns);
  void tell(std::int64_t now_ns, const std::string& kind, const std::string& text, double value = 0);
  void picture(const std::string& label, const std::string& caption);
  void announce(const assess::TrialSample& sample, std::int64_t now_ns);
  void publish(std::int64_t now_ns);
  const TrialPlan& plan() const { return setup_.plan[static_cast<std::size_t>(status_.trial - 1)]; }

  Setup setup_;
  runtime::Bus& bus_;
  TaskChannels& channels_;
  runtime::Executive& executive_;
  assess::TrialSampler sampler_;
  assess::PhaseDetector phases_;
  TaskStatus status_;
  std::vector<assess::TrialSample> samples_;
  std::vector<CompletedTrial> completed_;
  std::vector<runtime::Event> safety_events_;
  haptics::FlightRecord last_;         ///< newest tick seen
  std::string camera_ = runtime::cameraTrouble(nullptr, 0);   ///< what was last said of it
  std::optional<runtime::Displaced> displaced_;   ///< as it was last said
  std::int64_t trip_ns_ = 0, warm_ns_ = -1;   ///< of the last trip, of the last tick with warm drives
  std::int64_t since_ns_ = 0;          ///< the current state began
  double in_lumen_s_ = 0;              ///< dwell with the plunger drawn
  std::array<double, kOrganCount> touched_s_{};   ///< trial time of the last contact, by Organ
  bool entered_vein_ = false, quit_ = false;
};

}  // namespace palpa::task_needle

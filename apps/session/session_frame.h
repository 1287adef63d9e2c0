#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "apps/live/live_session.h"
#include "apps/record/session_file.h"
#include "apps/runtime/camera_activity.h"
#include "apps/runtime/executive.h"
#include "apps/runtime/haptic_activity.h"
#include "apps/runtime/recorders.h"
#include "apps/session/session_devices.h"
#include "apps/session/session_pictures.h"
#include "apps/session/stage.h"
#include "apps/sound/session_sound.h"
#include "apps/trial/trial_scene.h"
#include "apps/trial/trial_task.h"
#include "apps/twin/virtual_bench.h"

namespace palpa::session {

/// What a session leaves besides what its task judged.
struct SessionRun {
  std::vector<trial::SavedPicture> pictures;
  std::vector<runtime::Lateness> lateness;
  std::optional<twin::BenchAccuracy> accuracy;
  std::vector<RegistrationRow> registration;  ///< recorded pictures only
  std::vector<std::string> camera_remarks;    ///< settings that it did not accept
  struct Video {
    std::uint64_t pictures = 0;
    std::string trouble;  ///< empty: everything was kept
  };
  std::optional<Video> video;          ///< where one was recorded
  std::optional<ar::BoardPose> board;  ///< as it was seen last
  /// what took the force away, what a driver had to say
  std::vector<runtime::Event> safety_events;
  std::vector<report::Fact> devices;  ///< what their drivers counted
  std::string renderer;               ///< what drew into a window, as OpenGL names it; empty: none
  std::uint64_t dropped = 0;          ///< records lost by the recorder
  double simulated_s = 0;
  bool quit = false;
};

/// What a session took of the processor's time, ns; for `palpa bench session` alone.
struct SessionCost {
  bool by_stage = false;        ///< asked for: `steps` and `drawing_ns`, which cost something
  std::int64_t started_ns = 0;  ///< of the whole process, at the first step
  std::int64_t run_ns = 0;      ///< from the first step to the last, all threads
  std::int64_t thread_ns = 0;   ///< of these, the executive's own
  runtime::StepCosts steps;     ///< of these, each activity's
  /// Of the thread beside it: the bench's pictures until they are drawn
  std::atomic<std::int64_t> drawing_ns{0};
};

/// Every part of a session but its task and what that shows, made in the order in which one needs
/// the other. A task makes its own activities with these parts, and runs.
class SessionFrame {
 public:
  struct World {
    training::Engine engine;
    const station::Station& station;
    const anatomy::Patient& patient;  ///< what is shown
    Pose X_WA;
    haptics::TickConfig tick;
    /// of two devices in one tick, in place of `tick`
    std::optional<haptics::PairConfig> pair = {};
    bool fixed_views = true;
    const runtime::FloorSource* floors = nullptr;  ///< of a search
    live::NearMiss near = {};  ///< told to whoever looks on; empty: nothing is near
    /// Beats a minute of the patient's heart, where it may be heard: in no task in which it would
    /// tell an answer
    std::optional<double> heart_per_min = {};
    SessionCost* cost = nullptr;  ///< where it is wanted, in virtual time
  };
  SessionFrame(const SessionOptions& options, const World& world, SessionDevices::Hands hands,
               trial::Channels& channels, const std::filesystem::path& folder);

  /// Adds the activities and runs them until the task ends the session; `geometry` null: the tick
  /// asks for none. The evidence file is made last: a mistake in the set-up leaves none behind.
  SessionRun run(trial::TrialTask& task, trial::TrialScene& scene, record::SessionInfo info,
                 runtime::GeometryActivity* geometry = nullptr);

  /// Where and how the scene shows; with a window its keys are obeyed.
  trial::TrialScene::Stage stage(scene::HeadDisplay* head = nullptr);
  std::vector<runtime::BoardPlace> places() const;

  runtime::Bus& bus() { return bus_; }
  runtime::Executive& executive() { return *executive_; }
  SessionDevices& devices() { return devices_; }
  const DesktopStage& desktop() const { return stage_; }

 private:
  std::unique_ptr<runtime::Activity> loop(runtime::GeometryActivity* geometry);
  /// After the run, apart from what was recorded and what OpenIGTLink's links say.
  SessionRun leftBy(const trial::TrialTask& task, const trial::TrialScene& scene);
  void notePlace(std::int64_t now_ns);
  void remark(const std::string& words);
  void publish(const scene::SceneState& state, const trial::TrialStatus& status,
               std::int64_t now_ns);

  const SessionOptions& options_;
  const World world_;
  trial::Channels& channels_;
  const std::filesystem::path folder_;
  const bool window_;
  SessionPictures pictures_;
  const DesktopStage stage_;
  const std::unique_ptr<runtime::Executive> executive_;
  const runtime::TimeMode mode_;
  const std::unique_ptr<scene::StopKey> stop_key_;  ///< of a window, in real time
  runtime::Bus bus_;
  SessionDevices devices_;
  std::optional<sound::SessionSound> sound_;  ///< where one may be heard
  std::optional<runtime::VideoRecorder> video_;
  std::unique_ptr<live::LiveSession> live_;  ///< while somebody may look on
  bool picture_wanted_ = false;              ///< by one of them, of this frame
  std::optional<scene::WindowPlace> place_;  ///< of the window, not long ago
  std::int64_t place_asked_ns_ = 0;
};

}  // namespace palpa::session

#pragma once

#include <filesystem>
#include <vector>

#include "apps/cli/needle_world.h"
#include "apps/cli/session_devices.h"
#include "apps/cli/session_pictures.h"
#include "apps/cli/session_options.h"
#include "apps/runtime/executive.h"
#include "apps/task_needle/needle_task.h"
#include "apps/task_needle/scene_activity.h"
#include "apps/twin/virtual_bench.h"

namespace palpa::cli {

struct SessionResult {
  std::vector<task_needle::CompletedTrial> trials;
  std::vector<trial::SavedPicture> pictures;
  std::vector<runtime::Lateness> lateness;
  std::optional<twin::BenchAccuracy> accuracy;
  std::vector<RegistrationRow> registration;   ///< recorded pictures only
  std::vector<std::string> camera_remarks;   ///< settings that it did not accept
  struct Video {
    std::uint64_t pictures = 0;
    std::string trouble;             ///< empty: everything was kept
  };
  std::optional<Video> video;        ///< where one was recorded
  std::optional<ar::BoardPose> board;          ///< as it was seen last
  std::vector<runtime::Event> safety_events;   ///< what took the force away, what a driver had to say
  std::vector<SessionDevices::Fact> devices;   ///< what their drivers counted
  std::uint64_t dropped = 0;                   ///< records lost by the recorder
  double simulated_s = 0;
  bool quit = false;
};

/// Runs the trials: station, bench or person, camera, task, scene, recorder. Leaves session.palpa and
/// view-*.png in `folder`.
SessionResult runNeedleSession(const SessionOptions& options, NeedleWorld& world,
                               const std::filesystem::path& folder);

}  // namespace palpa::cli

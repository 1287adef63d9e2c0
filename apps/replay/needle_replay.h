#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "apps/assess/needle/phases.h"
#include "apps/assess/needle/trial_sampler.h"
#include "apps/replay/trial_replay.h"
#include "apps/runtime/bus.h"
#include "apps/task_needle/needle_task.h"
#include "apps/task_needle/task_file.h"
#include "haptics/flight_record.h"
#include "scene/scene_state.h"

namespace palpa::replay {

/// What was shown at a moment of a recorded needle trial, by its ticks alone.
struct NeedleMoment {
  double t_s = 0;  ///< since the trial's start; pauses do not count
  runtime::ToolState tool;
  assess::ProcedurePhase phase = assess::ProcedurePhase::approach;
  double blood = 0;                                 ///< filled fraction of the syringe
  Tissue holds = Tissue::air, flows = Tissue::air;  ///< as in TaskStatus
  bool asked = false;                               ///< what is aspirated
};

/// Takes a session's ticks in their order and keeps of one trial a moment every 4 ms: more than any
/// film shows.
class MomentReader {
 public:
  MomentReader(const Pose& X_AD, const PackedPose& X_ET, int trial);
  void add(const haptics::FlightRecord& record);
  const std::vector<NeedleMoment>& moments() const { return moments_; }

 private:
  Pose X_ET_;
  assess::TrialSampler sampler_;
  assess::PhaseDetector phases_;
  const assess::ScoringRules rules_;  ///< the usual ones: from where on a plunger counts as drawn
  assess::Syringe syringe_;
  double last_s_ = 0;
  std::vector<NeedleMoment> moments_;
};

/// What the task said of this moment. `trial`: its number and whether forces were felt.
task_needle::TaskStatus statusAt(const NeedleMoment& moment, int trial, bool force_feedback);

/// The camera's pictures that a session left beside its evidence ("camera.mjpeg": JPEG after JPEG;
/// "camera.mjpeg.csv": when each was taken), any of them at once. Nothing where there is none, or
/// where the table names fewer than one; a picture that cannot be read is passed over.
class RecordedPictures {
 public:
  explicit RecordedPictures(const std::filesystem::path& folder);
  bool empty() const { return times_ns_.empty(); }
  /// The last picture taken at or before this session time; null before the first.
  const scene::Image* at(std::int64_t t_ns);

 private:
  void findPictures();
  void read(std::size_t number);

  std::ifstream film_;
  std::vector<std::int64_t> times_ns_;
  std::vector<std::streamoff> begins_;  ///< of each picture, and the end
  std::size_t shown_ = SIZE_MAX;
  scene::Image image_;
};

/// A recorded needle trial, ready to be shown at any moment.
struct NeedleTrial : ShownTrial {
  task_needle::TaskWords words;
  std::vector<NeedleMoment> moments;  ///< not empty
  double length_s() const { return moments.back().t_s; }
};

/// `pictures` of the camera, shown in the view's inset; null: none. All outlive what is answered.
std::unique_ptr<TrialReplay> needleReplay(const NeedleTrial& trial, scene::SceneView& view,
                                          RecordedPictures* pictures = nullptr);

}  // namespace palpa::replay

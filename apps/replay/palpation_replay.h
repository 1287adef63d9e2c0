#pragma once

#include <memory>
#include <vector>

#include "apps/replay/trial_replay.h"
#include "apps/task_palpation/palpation_task.h"

namespace palpa::replay {

/// One in 10 ms of a palpation; so many samples were felt and marks made up to it.
struct PalpationMoment {
  double t_s = 0;  ///< since the trial's start; pauses do not count
  runtime::ToolState tool;
  std::size_t samples = 0, marks = 0;
};

/// A recorded palpation, ready to be shown at any moment. What lies inside is seen from the start:
/// who looks back may know it.
struct PalpationTrial : ShownTrial {
  assess::PalpationRules rules;
  double tip_radius = 0.008;             ///< m
  std::vector<PalpationMoment> moments;  ///< not empty
  std::vector<assess::PalpationSample> samples;
  std::vector<assess::LumpMark> pressed;  ///< the lumps that were marked
  std::vector<task_palpation::PalpationStatus::Shown> lumps;
  double length_s() const { return moments.back().t_s; }
};

/// Takes a session's ticks in their order and keeps those of one trial.
class PalpationReader {
 public:
  PalpationReader(const haptics::TickConfig& config, int trial);
  void add(const haptics::FlightRecord& record);
  double seconds() const { return listener_.seconds(); }
  void into(PalpationTrial& trial) const;  ///< moments, samples, marks

 private:
  Pose X_ET_;
  task_palpation::PalpationListener listener_;
  std::vector<PalpationMoment> moments_;
};

/// The trial and the view outlive what is answered.
std::unique_ptr<TrialReplay> palpationReplay(const PalpationTrial& trial, scene::SceneView& view);

}  // namespace palpa::replay

#pragma once

#include <string>
#include <vector>

#include "apps/assess/phase_detector.h"
#include "apps/assess/trial_sampler.h"
#include "apps/runtime/bus.h"
#include "apps/task_needle/task_status.h"
#include "haptics/flight_record.h"

namespace palpa::replay {

/// What was shown at a moment of a recorded needle trial, by its ticks alone.
struct Moment {
  double t_s = 0;  ///< since the trial's start; pauses do not count
  runtime::ToolState tool;
  assess::ProcedurePhase phase = assess::ProcedurePhase::approach;
  double blood = 0;  ///< filled fraction of the syringe
  bool blood_flows = false;
};

/// Takes a session's ticks in their order and keeps of one trial a moment every 4 ms: more than any
/// film shows.
class MomentReader {
 public:
  MomentReader(const Pose& X_AD, const PackedPose& X_ET, int trial);
  void add(const haptics::FlightRecord& record);
  const std::vector<Moment>& moments() const { return moments_; }

 private:
  Pose X_ET_;
  assess::TrialSampler sampler_;
  assess::PhaseDetector phases_;
  double blood_ = 0, last_s_ = 0;
  std::vector<Moment> moments_;
};

/// What the task said of this moment. `trial`: its number and whether forces were felt.
task_needle::TaskStatus statusAt(const Moment& moment, int trial, bool force_feedback);

}  // namespace palpa::replay

#pragma once

#include "apps/assess/phase_detector.h"
#include "apps/trial/trial_status.h"

namespace palpa::task_needle {

/// What the task tells the scene: for the HUD, the syringe, the pictures.
struct TaskStatus : trial::TrialStatus {
  assess::ProcedurePhase phase = assess::ProcedurePhase::approach;
  std::string step;               ///< what is being done, in words
  double plunger = 0, blood = 0;  ///< drawn, filled; fractions of the syringe
  bool blood_flows = false;
};

}  // namespace palpa::task_needle

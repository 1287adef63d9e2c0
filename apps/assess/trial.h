#pragma once

#include <string>

namespace palpa::assess {

/// Whether a trial of this role counts: a practice trial that is scored, or one in assessment,
/// where every aid is off.
inline bool countsAsScored(const std::string& role) {
  return role == "scored" || role == "assessed";
}

/// No aid is shown or felt.
inline bool inAssessment(const std::string& role) { return role == "assessed"; }

/// How long one of a task's parts was on in a trial, and what was added to the force meanwhile.
struct SubtaskDose {
  std::string subtask;  ///< as the task's file names it
  double on_s = 0;
  int times = 0;           ///< it came on
  double augmented_s = 0;  ///< a cue of its own was felt; what had begun may outlast the part
  double impulse_Ns = 0;   ///< of the cues
};

}  // namespace palpa::assess

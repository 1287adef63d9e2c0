#pragma once

#include <string>

namespace palpa::assess {

/// In place of a part's name: what is added at any time of a trial.
inline constexpr const char* kAnyPart = "any part";

/// How long one of a task's parts was on in a trial, and what was added to the force meanwhile.
struct SubtaskDose {
  std::string subtask;  ///< as the task's file names it
  double on_s = 0;
  int times = 0;           ///< it came on
  double augmented_s = 0;  ///< a cue of its own was felt; what had begun may outlast the part
  double impulse_Ns = 0;   ///< of the cues
  int occasions = 0;       ///< it came on and had been left for longer than a tremor
};

}  // namespace palpa::assess

#pragma once

#include <cstdint>
#include <string>

#include "apps/assess/palpation/palpation_score.h"
#include "apps/assess/subtask_dose.h"

namespace palpa::assess {

/// Of a palpation before anything is judged.
struct PalpationFacts {
  int trial = 0;  ///< 1, 2, ...; 0 stands for none
  std::string role = "scored";
  bool simulated = false, force_feedback = true;
  std::uint64_t seed = 1;
  std::string outcome;     ///< "done", "time", "aborted", "void"
  double guided = 0;       ///< share of the time in which something on the screen led the hand
  bool augmented = false;  ///< the task's augmentations added force
};

/// Found enough, felt enough: 90 % of lumps, 95 % of the area (MammaCare's standard, as studies of
/// clinical breast examination report it). False alarms are shown, and fail nobody.
struct PalpationStandard {
  double sensitivity = 0.9, coverage = 0.95;
};

/// One judged palpation, and what to say of it.
struct PalpationAssessment {
  PalpationFacts facts;
  std::vector<CaseLump> lumps;
  std::vector<LumpMark> marks;
  PalpationScore score;
  bool passed = false;
  std::string summary;              ///< one sentence: what was found and what was not
  std::vector<std::string> advice;  ///< what to do better, the most important first; sentences
  std::vector<SubtaskDose> doses;   ///< of the task's parts
};

PalpationAssessment assessPalpation(const PalpationFacts& facts, const PalpationRules& rules,
                                    const PalpationStandard& standard,
                                    const std::vector<CaseLump>& lumps, PalpationSamples samples,
                                    const std::vector<LumpMark>& marks);

}  // namespace palpa::assess

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/assess/palpation/palpation_score.h"
#include "apps/assess/trial.h"
#include "apps/training/trial_words.h"

namespace palpa::assess {

/// Of a palpation before anything is judged.
struct PalpationFacts {
  int trial = 0;  ///< 1, 2, ...; 0 stands for none
  training::Role role = training::Role::scored;
  bool simulated = false, force_feedback = true;
  std::uint64_t seed = 1;
  training::Outcome outcome = training::Outcome::none;
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

/// Cases that it takes before anybody passes or fails: two simulators of the abdomen measured with
/// a reliability of 0.35 and -0.41, as few cases do.
constexpr int kEnoughCases = 8;

/// Whether the standard is reached.
enum class PalpationVerdict { too_few_cases, passed, not_passed };

/// Of somebody, over all trials that count: scored, and neither void nor unfinished.
struct PalpationJudgement {
  PalpationVerdict verdict = PalpationVerdict::too_few_cases;
  int cases = 0, found = 0, lumps = 0;
  double coverage = 0;  ///< mean share of the area that was felt
};

bool counts(const PalpationAssessment& trial);

/// Passed: `kEnoughCases` or more, of all lumps the standard's share found, on average the
/// standard's share of the area felt. How reliable that is is not measured here.
PalpationJudgement judgementOf(const std::vector<PalpationAssessment>& trials,
                               const PalpationStandard& standard);

/// All figures of a palpation, as metric_table defines them.
std::vector<metrics::MetricValue> palpationMetrics(const PalpationAssessment& assessment);

}  // namespace palpa::assess

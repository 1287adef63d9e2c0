#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/assess/palpation/palpation_score.h"
#include "apps/assess/statistics/sample.h"
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
  double guided = 0;        ///< share of the time in which something on the screen led the hand
  bool augmented = false;   ///< the task's augmentations added force
  bool taken_away = false;  ///< a lump that lies in the phantom was taken away
};

/// Found enough, felt enough: 90 % of lumps, 95 % of the area (MammaCare's standard, as studies of
/// clinical breast examination report it). Who presses a grid with a fingertip's weight, or calls
/// every place ill, reaches both: so a task also asks how much was felt deeply, and how many false
/// alarms there may be. Without those two it asks for neither, as the first tasks did.
struct PalpationStandard {
  double sensitivity = 0.9, coverage = 0.95;                      ///< shares
  double deep_coverage = 0;                                       ///< share of the area
  double false_alarms = std::numeric_limits<double>::infinity();  ///< a case, at most
};

/// What of the standard was missed.
enum class Shortfall { sensitivity, coverage, deep_coverage, false_alarms };

/// Of one search, or on average of several.
struct PalpationReached {
  double sensitivity = 0, coverage = 0, deep_coverage = 0, false_alarms = 0;
};
std::vector<Shortfall> shortOf(const PalpationStandard& standard, const PalpationReached& reached);

/// One judged palpation, and what to say of it.
struct PalpationAssessment {
  PalpationFacts facts;
  std::vector<CaseLump> lumps;
  std::vector<LumpMark> marks;
  PalpationScore score;
  bool passed = false;
  std::vector<Shortfall> below;     ///< of the standard
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

/// Whether the standard is reached. Without a lump nothing can be found; without a case that has
/// none nobody can show, where false alarms are limited, to leave such a case alone.
enum class PalpationVerdict { no_lump, too_few_cases, no_clear_case, passed, not_passed };

/// Of somebody, over all trials that count: scored, and neither void nor unfinished.
struct PalpationJudgement {
  PalpationVerdict verdict = PalpationVerdict::no_lump;
  int cases = 0, clear_cases = 0, found = 0, lumps = 0;
  PalpationReached reached;         ///< of all lumps; means over the cases
  std::vector<Shortfall> below;     ///< of the standard
  statistics::Detections quarters;  ///< with a lump in them, and clear ones
};

bool counts(const PalpationAssessment& trial);

/// Passed: `kEnoughCases` or more, one without a lump among them, of all lumps the standard's share
/// found, on average the standard's shares of the area felt and no more false alarms than it
/// allows. How reliable that is is not measured here.
PalpationJudgement judgementOf(const std::vector<PalpationAssessment>& trials,
                               const PalpationStandard& standard);

/// All figures of a palpation, as metric_table defines them.
std::vector<metrics::MetricValue> palpationMetrics(const PalpationAssessment& assessment);

}  // namespace palpa::assess

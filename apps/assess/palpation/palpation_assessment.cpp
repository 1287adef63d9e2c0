#include "apps/assess/palpation/palpation_assessment.h"

#include <limits>

#include "apps/assess/palpation/palpation_words.h"

namespace palpa::assess {

using training::Outcome;

PalpationAssessment assessPalpation(const PalpationFacts& facts, const PalpationRules& rules,
                                    const PalpationStandard& standard,
                                    const std::vector<CaseLump>& lumps, PalpationSamples samples,
                                    const std::vector<LumpMark>& marks) {
  PalpationAssessment assessment;
  assessment.facts = facts;
  assessment.lumps = lumps;
  assessment.marks = marks;
  assessment.score = scorePalpation(rules, lumps, samples, marks);
  const bool finished = facts.outcome != Outcome::aborted && facts.outcome != Outcome::voided;
  assessment.passed = finished && assessment.score.sensitivity() >= standard.sensitivity &&
                      assessment.score.coverage[0] >= standard.coverage;
  assessment.summary = palpationSummary(facts, assessment.score);
  assessment.advice = palpationAdvice(assessment, rules, standard, samples);
  return assessment;
}

bool counts(const PalpationAssessment& trial) {
  const PalpationFacts& facts = trial.facts;
  return (facts.role == training::Role::none || training::countsAsScored(facts.role)) &&
         !facts.augmented && facts.outcome != Outcome::voided && facts.outcome != Outcome::none;
}

PalpationJudgement judgementOf(const std::vector<PalpationAssessment>& trials,
                               const PalpationStandard& standard) {
  PalpationJudgement judgement;
  double felt = 0;
  for (const PalpationAssessment& trial : trials) {
    if (!counts(trial)) continue;
    ++judgement.cases;
    judgement.found += trial.score.found;
    judgement.lumps += trial.score.found + trial.score.missed;
    felt += trial.score.coverage[0];
  }
  if (judgement.cases > 0) judgement.coverage = felt / judgement.cases;
  if (judgement.cases < kEnoughCases || judgement.lumps == 0) return judgement;
  const bool reached = judgement.found >= standard.sensitivity * judgement.lumps &&
                       judgement.coverage >= standard.coverage;
  judgement.verdict = reached ? PalpationVerdict::passed : PalpationVerdict::not_passed;
  return judgement;
}

std::vector<metrics::MetricValue> palpationMetrics(const PalpationAssessment& a) {
  const PalpationScore& s = a.score;
  const double none = std::numeric_limits<double>::quiet_NaN();
  const bool touched = s.peak > 0;
  return {{"success", a.passed ? 1.0 : 0.0},
          {"time_s", s.seconds},
          {"sensitivity_pct", s.found + s.missed > 0 ? 100 * s.sensitivity() : none},
          {"specificity_pct", s.clear_quadrants > 0 ? 100 * s.specificity() : none},
          {"false_alarms", static_cast<double>(s.false_alarms)},
          {"coverage_light_pct", 100 * s.coverage[0]},
          {"coverage_medium_pct", 100 * s.coverage[1]},
          {"coverage_deep_pct", 100 * s.coverage[2]},
          {"felt_twice_pct", 100 * s.twice},
          {"presses", static_cast<double>(s.presses)},
          {"closer_force_ratio", s.closer_force > 0 ? s.closer_force : none},
          {"too_light_pct", touched ? 100 * s.too_light : none},
          {"too_hard_pct", touched ? 100 * s.too_hard : none},
          {"peak_force_N", s.peak},
          {"mean_force_N", touched ? s.mean : none}};
}

}  // namespace palpa::assess

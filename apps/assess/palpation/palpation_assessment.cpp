#include "apps/assess/palpation/palpation_assessment.h"

#include <cmath>
#include <limits>

#include "apps/assess/palpation/palpation_words.h"

namespace palpa::assess {

using training::Outcome;

std::vector<Shortfall> shortOf(const PalpationStandard& standard, const PalpationReached& reached) {
  std::vector<Shortfall> below;
  if (reached.sensitivity < standard.sensitivity) below.push_back(Shortfall::sensitivity);
  if (reached.coverage < standard.coverage) below.push_back(Shortfall::coverage);
  if (reached.deep_coverage < standard.deep_coverage) below.push_back(Shortfall::deep_coverage);
  if (reached.false_alarms > standard.false_alarms) below.push_back(Shortfall::false_alarms);
  return below;
}

namespace {

PalpationReached reachedIn(const PalpationScore& score) {
  return {score.sensitivity(), score.coverage.front(), score.coverage.back(),
          static_cast<double>(score.false_alarms)};
}

}  // namespace

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
  assessment.below = shortOf(standard, reachedIn(assessment.score));
  assessment.passed = finished && assessment.below.empty();
  assessment.summary = palpationSummary(facts, assessment.score);
  assessment.advice = palpationAdvice(assessment, rules, standard, samples);
  return assessment;
}

bool counts(const PalpationAssessment& trial) {
  const PalpationFacts& facts = trial.facts;
  return (facts.role == training::Role::none || training::countsAsScored(facts.role)) &&
         !facts.augmented && facts.outcome != Outcome::voided && facts.outcome != Outcome::none;
}

namespace {

void add(const PalpationScore& score, PalpationJudgement* sums) {
  ++sums->cases;
  const int lumps = score.found + score.missed;
  sums->clear_cases += lumps == 0;
  sums->found += score.found;
  sums->lumps += lumps;
  const PalpationReached here = reachedIn(score);
  sums->reached.coverage += here.coverage;
  sums->reached.deep_coverage += here.deep_coverage;
  sums->reached.false_alarms += here.false_alarms;
  sums->quarters.signals += score.ill_quadrants;
  sums->quarters.hits += score.hit_quadrants;
  sums->quarters.rest += score.clear_quadrants;
  sums->quarters.alarms += score.wrong_quadrants;
}

PalpationVerdict verdictOf(const PalpationJudgement& judgement, const PalpationStandard& standard) {
  if (judgement.lumps == 0) return PalpationVerdict::no_lump;
  if (judgement.cases < kEnoughCases) return PalpationVerdict::too_few_cases;
  if (judgement.clear_cases == 0 && std::isfinite(standard.false_alarms))
    return PalpationVerdict::no_clear_case;
  return judgement.below.empty() ? PalpationVerdict::passed : PalpationVerdict::not_passed;
}

}  // namespace

PalpationJudgement judgementOf(const std::vector<PalpationAssessment>& trials,
                               const PalpationStandard& standard) {
  PalpationJudgement judgement;
  for (const PalpationAssessment& trial : trials)
    if (counts(trial)) add(trial.score, &judgement);
  if (judgement.cases == 0) return judgement;
  PalpationReached& reached = judgement.reached;
  for (double* sum : {&reached.coverage, &reached.deep_coverage, &reached.false_alarms})
    *sum /= judgement.cases;
  reached.sensitivity =
      judgement.lumps > 0 ? static_cast<double>(judgement.found) / judgement.lumps : 1;
  judgement.below = shortOf(standard, reached);
  judgement.verdict = verdictOf(judgement, standard);
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

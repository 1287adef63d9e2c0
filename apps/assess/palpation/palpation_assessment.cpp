#include "apps/assess/palpation/palpation_assessment.h"

#include "apps/assess/palpation/palpation_words.h"

namespace palpa::assess {

PalpationAssessment assessPalpation(const PalpationFacts& facts, const PalpationRules& rules,
                                    const PalpationStandard& standard,
                                    const std::vector<CaseLump>& lumps, PalpationSamples samples,
                                    const std::vector<LumpMark>& marks) {
  PalpationAssessment assessment;
  assessment.facts = facts;
  assessment.lumps = lumps;
  assessment.marks = marks;
  assessment.score = scorePalpation(rules, lumps, samples, marks);
  const bool finished = facts.outcome != "aborted" && facts.outcome != "void";
  assessment.passed = finished && assessment.score.sensitivity() >= standard.sensitivity &&
                      assessment.score.coverage[0] >= standard.coverage;
  assessment.summary = palpationSummary(facts, assessment.score);
  assessment.advice = palpationAdvice(assessment, rules, standard, samples);
  return assessment;
}

}  // namespace palpa::assess

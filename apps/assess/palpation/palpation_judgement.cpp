#include "apps/assess/palpation/palpation_judgement.h"
#include "apps/assess/trial_role.h"

namespace palpa::assess {

bool counts(const PalpationAssessment& trial) {
  const PalpationFacts& facts = trial.facts;
  return (facts.role.empty() || countsAsScored(facts.role)) && !facts.augmented &&
         facts.outcome != "void" && !facts.outcome.empty();
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
  judgement.verdict =
      reached ? PalpationJudgement::Verdict::passed : PalpationJudgement::Verdict::not_passed;
  return judgement;
}

}  // namespace palpa::assess

#pragma once

#include "apps/assess/trial_review.h"

namespace palpa::assess {

/// The nine lines of the score, in the paper's order, each with its reason in clinical words. A
/// line without penalty says briefly what was right.
std::vector<Penalty> explain(const TrialReview& review, const calibration::ExpertPath& path,
                             const ScoringRules& rules);

/// The same in parts: COL_*, and the rest.
std::vector<Penalty> explainCollisions(const TrialReview& review, const ScoringRules& rules);
std::vector<Penalty> explainPath(const TrialReview& review, const calibration::ExpertPath& path,
                                 const ScoringRules& rules);

/// Verdict first, then the largest penalty.
std::string summarise(const TrialFacts& facts, const TrialReview& review,
                      const std::vector<Penalty>& penalties);

}  // namespace palpa::assess

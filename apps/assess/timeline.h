#pragma once

#include "apps/assess/trial_review.h"

namespace palpa::assess {

/// Stretches for the timeline: phases, then what was touched. Ordered by kind of thing, then time.
std::vector<Span> timelineSpans(const TrialReview& review, const ScoringRules& rules);

/// What happened when, in clinical words, in order of time.
std::vector<Moment> timelineMoments(const TrialFacts& facts, const TrialReview& review,
                                    const ScoringRules& rules);

}  // namespace palpa::assess

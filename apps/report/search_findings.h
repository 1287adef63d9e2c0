#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/assess/search/search_trial.h"
#include "apps/report/html.h"

namespace palpa::report {

/// "full stiffness", "degraded", "augmented".
const char* stiffnessWords(assess::SearchMode mode);

/// "In 10 of 10 episodes with full stiffness the target was found, 95 % interval 72 % to 100 %. The
/// choice took 21 s (median)."
std::string foundSentence(const assess::SearchTally& tally);

/// What the cues gave back, in words; "" where there were no cues.
std::string recoverySentence(const std::vector<assess::SearchTrial>& trials, std::uint64_t seed);

/// All of it, and the chart of shares, in a card.
void writeSearchFindings(Html& html, const std::vector<assess::SearchTrial>& trials);

}  // namespace palpa::report

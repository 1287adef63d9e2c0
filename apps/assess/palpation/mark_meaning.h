#pragma once

#include <cstddef>

#include "apps/assess/palpation/palpation_score.h"

namespace palpa::assess {

/// What became of a mark: it found a lump, it said again what had been said, or there was nothing.
enum class MarkMeaning { found, repeated, false_alarm };

/// Of mark `mark` (from 0) of a search that has been scored. The counts of the score are the counts
/// of these.
MarkMeaning meaningOf(std::size_t mark, const PalpationRules& rules, const PalpationScore& score,
                      const std::vector<CaseLump>& lumps, const std::vector<LumpMark>& marks);

}  // namespace palpa::assess

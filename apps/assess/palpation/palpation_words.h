#pragma once

#include <string>
#include <vector>

#include "apps/assess/palpation/palpation_assessment.h"

namespace palpa::assess {

/// "Found 2 of 3 lumps, one false alarm; 91 % of the area was felt."
std::string palpationSummary(const PalpationFacts& facts, const PalpationScore& score);

/// "too few lumps found", "too many false alarms", ...
const char* wordsOf(Shortfall below);

/// "90 % of the lumps and 95 % of the area, 90 % of it deeply, with no more than 1 false alarm a
/// case".
std::string standardWords(const PalpationStandard& standard);

/// Sentences for the trainee, the most important first; empty when there is nothing to improve.
std::vector<std::string> palpationAdvice(const PalpationAssessment& assessment,
                                         const PalpationRules& rules,
                                         const PalpationStandard& standard,
                                         PalpationSamples samples);

/// Numbers as text, the same in every locale and wherever a page says them: "91 %", "58.7 %"
/// (rounded down, so that no share is said to reach a standard that it misses), "1.20 N" as "1.2
/// N".
std::string percentWords(double share);
std::string newtonWords(double newtons);

/// "a", "a and b", "a, b and c".
std::string joinedWords(const std::vector<std::string>& parts);

}  // namespace palpa::assess

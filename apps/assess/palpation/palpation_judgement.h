#pragma once

#include <vector>

#include "apps/assess/palpation/palpation_assessment.h"

namespace palpa::assess {

/// Cases that it takes before anybody passes or fails: two simulators of the abdomen measured with
/// a reliability of 0.35 and -0.41, as few cases do.
constexpr int kEnoughCases = 8;

/// Of somebody, over all trials that count: scored, and neither void nor unfinished.
struct PalpationJudgement {
  enum class Verdict { too_few_cases, passed, not_passed };
  Verdict verdict = Verdict::too_few_cases;
  int cases = 0, found = 0, lumps = 0;
  double coverage = 0;  ///< mean share of the area that was felt
};

bool counts(const PalpationAssessment& trial);

/// Passed: `kEnoughCases` or more, of all lumps the standard's share found, on average the
/// standard's share of the area felt. How reliable that is is not measured here.
PalpationJudgement judgementOf(const std::vector<PalpationAssessment>& trials,
                               const PalpationStandard& standard);

}  // namespace palpa::assess

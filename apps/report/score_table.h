#pragma once

#include <vector>

#include "apps/assess/trial_assessment.h"
#include "apps/report/html.h"

namespace palpa::report {

/// Largest points first; equal ones as they came.
std::vector<assess::Penalty> byPoints(std::vector<assess::Penalty> penalties);

/// Each penalty: title, reason with its moments, value x weight = points, a bar; then the total.
void writeScoreTable(Html& html, const assess::TrialAssessment& assessment);

}  // namespace palpa::report

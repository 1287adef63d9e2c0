#pragma once

#include "apps/assess/trial_assessment.h"
#include "apps/report/html.h"

namespace palpa::report {

/// How close the tip came to pleura and artery, with the moment, in words and on a scale from 5 mm
/// inside to 20 mm away.
void writeNearMisses(Html& html, const assess::TrialAssessment& assessment);

}  // namespace palpa::report

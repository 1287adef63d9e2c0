#pragma once

#include <vector>

#include "apps/assess/trial_assessment.h"

namespace palpa::cli {

/// Every tenth tick for the plots; what happened in between is merged into the one kept.
std::vector<assess::TrialSample> thinned(const std::vector<assess::TrialSample>& samples);

}  // namespace palpa::cli

#pragma once

#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/assess/palpation/palpation_assessment.h"

namespace palpa::assess {

/// All figures of a palpation, as metric_table defines them.
std::vector<metrics::MetricValue> palpationMetrics(const PalpationAssessment& assessment);

}  // namespace palpa::assess

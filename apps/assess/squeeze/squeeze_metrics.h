#pragma once

#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/assess/squeeze/squeeze_trial.h"

namespace palpa::assess {

/// All figures of a comparison, as metric_table defines them.
std::vector<metrics::MetricValue> squeezeMetrics(const SqueezeTrial& trial);

}  // namespace palpa::assess

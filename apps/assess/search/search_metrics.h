#pragma once

#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/assess/search/search_trial.h"

namespace palpa::assess {

/// All figures of an episode, as metric_table defines them.
std::vector<metrics::MetricValue> searchMetrics(const SearchTrial& trial);

}  // namespace palpa::assess

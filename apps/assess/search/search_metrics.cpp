#include "apps/assess/search/search_metrics.h"

#include <limits>

namespace palpa::assess {

std::vector<metrics::MetricValue> searchMetrics(const SearchTrial& t) {
  return {{"success", t.found() ? 1.0 : 0.0},
          {"time_s", t.seconds},
          {"chosen", chose(t) ? 1.0 : 0.0},
          {"path_length_mm", 1e3 * t.path_m},
          {"mean_speed_mm_s",
           t.seconds > 0 ? 1e3 * t.path_m / t.seconds : std::numeric_limits<double>::quiet_NaN()},
          {"peak_force_N", t.peak_force_N},
          {"mean_force_N",
           t.peak_force_N > 0 ? t.mean_force_N : std::numeric_limits<double>::quiet_NaN()}};
}

}  // namespace palpa::assess

#include "apps/assess/squeeze/squeeze_metrics.h"

namespace palpa::assess {

std::vector<metrics::MetricValue> squeezeMetrics(const SqueezeTrial& t) {
  return {{"success", t.right() ? 1.0 : 0.0},
          {"time_s", t.seconds},
          {"difference_pct", 100 * (t.ratio() - 1)},
          {"grips", static_cast<double>(t.grips[0] + t.grips[1])},
          {"peak_force_N", t.peak_N}};
}

}  // namespace palpa::assess

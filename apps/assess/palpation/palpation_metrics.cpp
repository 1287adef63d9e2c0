#include "apps/assess/palpation/palpation_metrics.h"

#include <limits>

namespace palpa::assess {

std::vector<metrics::MetricValue> palpationMetrics(const PalpationAssessment& a) {
  const PalpationScore& s = a.score;
  const double none = std::numeric_limits<double>::quiet_NaN();
  const bool touched = s.peak > 0;
  return {{"success", a.passed ? 1.0 : 0.0},
          {"time_s", s.seconds},
          {"sensitivity_pct", s.found + s.missed > 0 ? 100 * s.sensitivity() : none},
          {"specificity_pct", s.clear_quadrants > 0 ? 100 * s.specificity() : none},
          {"false_alarms", static_cast<double>(s.false_alarms)},
          {"coverage_light_pct", 100 * s.coverage[0]},
          {"coverage_medium_pct", 100 * s.coverage[1]},
          {"coverage_deep_pct", 100 * s.coverage[2]},
          {"felt_twice_pct", 100 * s.twice},
          {"presses", static_cast<double>(s.presses)},
          {"closer_force_ratio", s.closer_force > 0 ? s.closer_force : none},
          {"too_light_pct", touched ? 100 * s.too_light : none},
          {"too_hard_pct", touched ? 100 * s.too_hard : none},
          {"peak_force_N", s.peak},
          {"mean_force_N", touched ? s.mean : none}};
}

}  // namespace palpa::assess

#pragma once

#include "apps/assess/technical_errors.h"

namespace palpa::assess {

/// How the procedure was carried out, as metric_table defines it: place and aim by parts, suction,
/// drawing back, injuries by number, the six errors (0 or 1).
std::vector<metrics::MetricValue> techniqueMetrics(const TrialReview& review,
                                                   const std::vector<TechnicalError>& errors,
                                                   const anatomy::LandmarkFrame& frame,
                                                   const calibration::ExpertPath& path,
                                                   const ScoringRules& rules);

}  // namespace palpa::assess

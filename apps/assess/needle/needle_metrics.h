#pragma once

#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/assess/needle/assess_trial.h"
#include "apps/assess/needle/technical_errors.h"
#include "apps/assess/needle/trial_review.h"

namespace palpa::assess {

/// How the procedure was carried out, as metric_table defines it: place and aim by parts, suction,
/// drawing back, injuries by number, the six errors (0 or 1).
std::vector<metrics::MetricValue> techniqueMetrics(const TrialReview& review,
                                                   const std::vector<TechnicalError>& errors,
                                                   const anatomy::LandmarkFrame& frame,
                                                   const calibration::TaughtPath& path,
                                                   const ScoringRules& rules);

/// Figures of a needle's motion and force that need no expert path; samples up to the end that is
/// judged.
std::vector<metrics::MetricValue> motionMetrics(Samples samples, const ScoringRules& rules);

/// All figures of a trial with an expert path, as metric_table defines them. `assessment`: of the
/// same review.
std::vector<metrics::MetricValue> needleMetrics(const TrialReview& review,
                                                const TrialAssessment& assessment,
                                                const anatomy::LandmarkFrame& frame,
                                                const calibration::TaughtPath& path,
                                                const ScoringRules& rules);

/// The figures of a trial without an expert path: success, time and motion; from its outcome and
/// values.
std::vector<metrics::MetricValue> goalMetrics(const TrialAssessment& assessment, Samples samples,
                                              const ScoringRules& rules);

}  // namespace palpa::assess

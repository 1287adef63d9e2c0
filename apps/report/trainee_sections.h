#pragma once

#include "apps/assess/progress/history.h"
#include "apps/assess/statistics/cusum.h"
#include "apps/report/html.h"

/// The parts of a trainee's page after the summary.
namespace palpa::report {

void writeLearningSection(Html& html, const progress::Series& series);
/// CUSUM and what may be said by it; of palpation only from eight cases on.
void writeCompetenceSection(Html& html, const progress::Series& series,
                            const statistics::CusumRates& rates);
/// Tests to come, and what pauses cost.
void writeRetentionSection(Html& html, const progress::Series& series,
                           const statistics::CusumRates& rates);
void writeErrorSection(Html& html, const progress::Series& series);

}  // namespace palpa::report

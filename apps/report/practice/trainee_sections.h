#pragma once

#include "apps/assess/progress/history.h"
#include "apps/assess/statistics/cusum.h"
#include "apps/report/page/html.h"

namespace palpa::report {

/// What an educator reads in a minute: how much, what got better, what costs most, nearest misses,
/// what recurs, what to practise next.
void writeTraineeSummary(Html& html, const progress::Series& series);

/// "34 scored trials in 5 sessions, 2027-01-10 to 2027-03-02 (51 days)"
std::string extentOf(const progress::Series& series);

}  // namespace palpa::report

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

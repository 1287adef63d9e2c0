#pragma once

#include "apps/assess/progress/history.h"
#include "apps/report/html.h"

namespace palpa::report {

/// What an educator reads in a minute: how much, what got better, what costs most, nearest misses,
/// what recurs, what to practise next.
void writeTraineeSummary(Html& html, const progress::Series& series);

/// "34 scored trials in 5 sessions, 2027-01-10 to 2027-03-02 (51 days)"
std::string extentOf(const progress::Series& series);

}  // namespace palpa::report

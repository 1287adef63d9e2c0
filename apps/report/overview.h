#pragma once

#include <vector>

#include "apps/report/html.h"
#include "apps/report/session_report.h"

namespace palpa::report {

/// All trials of the session: total per trial as a line, then a table. For two trials or more.
void writeOverview(Html& html, const std::vector<TrialPage>& trials);

}  // namespace palpa::report

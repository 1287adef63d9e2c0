#pragma once

#include "apps/report/html.h"
#include "apps/report/palpation_report.h"

namespace palpa::report {

/// How hard it was pressed, over time, with the levels as lines and the marks at their moments.
/// Drawn wide and narrow.
void writePressingChart(Html& html, const PalpationPage& page);

}  // namespace palpa::report

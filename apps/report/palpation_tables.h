#pragma once

#include "apps/report/html.h"
#include "apps/report/palpation_report.h"

namespace palpa::report {

/// Each lump: where and how large it is, whether it was found, how far off place, size and grading
/// were. Then what the false alarms are.
void writeLumpTable(Html& html, const PalpationPage& page);

/// Coverage, pattern, forces, time.
void writePalpationFigures(Html& html, const PalpationPage& page);

}  // namespace palpa::report

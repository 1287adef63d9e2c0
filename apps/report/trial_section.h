#pragma once

#include "apps/report/html.h"
#include "apps/report/session_report.h"

namespace palpa::report {

/// One trial: verdict, score, course, near misses, pictures.
void writeTrialSection(Html& html, const TrialPage& page);

}  // namespace palpa::report

#pragma once

#include <string_view>

#include "apps/report/html.h"
#include "apps/report/session_report.h"

namespace palpa::report {

/// Which of the six common errors were made, when, and why that matters; then pass or fail with its
/// reasons, and the checklist with what was done, not done, did not arise, or nobody has judged.
/// Nothing for a trial that was judged by no taught path.
void writeCompetence(Html& html, const TrialPage& page);

std::string_view competenceStyle();

}  // namespace palpa::report

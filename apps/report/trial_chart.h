#pragma once

#include "apps/report/html.h"
#include "apps/report/session_report.h"

namespace palpa::report {

/// The course of a trial over one time axis: numbered moments, lanes, force, depth. The moments run
/// as thin lines through all of it. Drawn wide and narrow.
void writeTrialChart(Html& html, const TrialPage& page);

/// End of the time axis, s: the last thing that happened.
double durationOf(const TrialPage& page);

/// The moments in order of time: the numbers in chart and list.
std::vector<assess::Moment> orderedMoments(const assess::TrialAssessment& assessment);

}  // namespace palpa::report

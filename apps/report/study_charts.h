#pragma once

#include "apps/report/html.h"
#include "apps/study_analysis/exhibit.h"

namespace palpa::report {

/// A plot of a study's results, wide and narrow: means over trials with bands, bars with intervals,
/// a line a subject, a mark a subject. Groups and conditions differ in dash and shape as well as
/// colour.
void writeStudyPlot(Html& html, const study_analysis::Plot& plot, const std::string& label);

/// CSS of these plots.
std::string_view studyChartStyle();

}  // namespace palpa::report

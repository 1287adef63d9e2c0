#pragma once

#include <string>

#include "apps/calibrate/result.h"
#include "apps/report/html.h"

namespace palpa::calibrate {

/// Dots over what they were measured at; those left out are crosses, so that more than their colour
/// differs.
void drawPlot(report::Html& html, const Plot& plot);

/// The picture in cells, darker where more corners were seen; an empty cell is framed in dashes.
void drawCoverage(report::Html& html, const Coverage& coverage);

/// Added to the page's style sheet.
std::string plotStyle();

}  // namespace palpa::calibrate

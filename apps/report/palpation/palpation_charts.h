#pragma once

#include <string>

#include "apps/report/page/html.h"
#include "apps/report/palpation/palpation_report.h"

/// The signs of a map of what was felt: told apart by shape, dash and number of pips, besides
/// colour.
namespace palpa::report {

/// Rectangle, to be joined with others in one SVG path.
std::string cellPath(double x, double y, double width, double height);

/// As many dots as the level about (x, y), `step` from one another; "" at level 0.
std::string pipsPath(int level, double x, double y, double step);

void drawLumpRing(Html& svg, double x, double y, double radius,
                  bool found);  ///< found: solid; missed: dashed
void drawMarkSign(Html& svg, double x, double y, bool false_alarm);  ///< a cross; a crossed square

/// The name of a lump in picture and table: A, B, ...
std::string lumpName(std::size_t index);

/// The searched area from above as the trainee saw it: how firmly each cell has been felt, where
/// lumps are, what was marked. Drawn wide and narrow.
void writeCoverageChart(Html& html, const PalpationPage& page);

/// How hard it was pressed, over time, with the levels as lines and the marks at their moments.
/// Drawn wide and narrow.
void writePressingChart(Html& html, const PalpationPage& page);

}  // namespace palpa::report

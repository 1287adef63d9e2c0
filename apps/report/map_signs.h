#pragma once

#include <string>

#include "apps/report/html.h"

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

}  // namespace palpa::report

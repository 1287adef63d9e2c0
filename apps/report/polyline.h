#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/report/axis.h"

namespace palpa::report {

struct Point {
  double x = 0, y = 0;
};

/// At most four points for each column of `column_px` of the picture: the first, lowest, highest
/// and last, in order of time. No extreme is lost. A value that is no number interrupts the line.
std::vector<std::vector<Point>> decimated(const std::vector<Point>& points, const Axis& x,
                                          double column_px = 1);

/// The same as the `d` of an SVG path.
std::string linePath(const std::vector<Point>& points, const Axis& x, const Axis& y);

/// Closed down to `base` (in units of y), for a fill under the line.
std::string areaPath(const std::vector<Point>& points, const Axis& x, const Axis& y, double base);

}  // namespace palpa::report

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/report/plot/chart_frame.h"

namespace palpa::report {

struct ChartPoint {
  double x = 0, y = 0;
};

/// At most four points for each column of `column_px` of the picture: the first, lowest, highest
/// and last, in order of time. No extreme is lost. A value that is no number interrupts the line.
std::vector<std::vector<ChartPoint>> decimated(const std::vector<ChartPoint>& points, const Axis& x,
                                               double column_px = 1);

/// The same as the `d` of an SVG path.
std::string linePath(const std::vector<ChartPoint>& points, const Axis& x, const Axis& y);

/// Closed down to `base` (in units of y), for a fill under the line.
std::string areaPath(const std::vector<ChartPoint>& points, const Axis& x, const Axis& y,
                     double base);

/// A line of a plot; `css` gives colour and dash, so that lines differ in more than colour.
struct PlotCurve {
  std::string label;
  std::string css;
  std::vector<ChartPoint> points;
  bool filled = false;  ///< shaded down to zero
};

/// A plot in a band of a larger picture; shares its time axis with the bands above and below.
struct PlotPanel {
  std::string title, unit;  ///< no title: no heading
  std::vector<PlotCurve> curves;
  double y_top = 1, y_bottom = 0;  ///< values at the upper and lower edge
  double height = 140;
};

/// Space that the panel's heading takes above the plot itself.
double headingHeight(const ChartFrame& frame);

/// Grid, value axis with title and unit, legend, lines. `top` is the upper edge of the plot itself.
void drawPanel(Html& svg, const ChartFrame& frame, const Axis& x, double top,
               const PlotPanel& panel);

}  // namespace palpa::report

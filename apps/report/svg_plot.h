#pragma once

#include <string>
#include <vector>

#include "apps/report/chart_frame.h"
#include "apps/report/polyline.h"

namespace palpa::report {

/// A line of a plot; `css` gives colour and dash, so that lines differ in more than colour.
struct Curve {
  std::string label;
  std::string css;
  std::vector<Point> points;
  bool filled = false;  ///< shaded down to zero
};

/// A plot in a band of a larger picture; shares its time axis with the bands above and below.
struct PlotPanel {
  std::string title, unit;  ///< no title: no heading
  std::vector<Curve> curves;
  double y_top = 1, y_bottom = 0;  ///< values at the upper and lower edge
  double height = 140;
};

/// Space that the panel's heading takes above the plot itself.
double headingHeight(const ChartFrame& frame);

/// Grid, value axis with title and unit, legend, lines. `top` is the upper edge of the plot itself.
void drawPanel(Html& svg, const ChartFrame& frame, const Axis& x, double top,
               const PlotPanel& panel);

}  // namespace palpa::report

#include "apps/report/svg_plot.h"

#include <algorithm>

namespace palpa::report {
namespace {

constexpr double kLineHeight = 18;

void drawGrid(Html& svg, const Axis& x, const Axis& y, double height) {
  const double low = std::min(y.from, y.to), high = std::max(y.from, y.to);
  const Ticks ticks = niceTicks(low, high, std::max(3, static_cast<int>(height / 26)));
  for (const double value : ticks.values) {
    svgLine(svg, value == 0 ? "zero" : "grid", x.from_px, y.at(value), x.to_px, y.at(value));
    svgText(svg, "tick end", x.from_px - 7, y.at(value) + 4, ticks.label(value));
  }
}

void drawSample(Html& svg, const Curve& curve, double x, double y) {
  svgLine(svg, "curve " + curve.css, x, y - 4, x + 24, y - 4);
  svgText(svg, "legend", x + 30, y, curve.label);
}

/// Title, unit and legend: in the left margin where there is one, else in a line above.
void drawHeading(Html& svg, const ChartFrame& frame, double top, const PlotPanel& panel) {
  if (panel.title.empty()) return;
  const std::string title = panel.title + ", " + panel.unit;
  if (frame.wide) {
    svgText(svg, "label strong", 0, top + 12, title);
    double y = top + 14;
    if (panel.curves.size() < 2) return;
    for (const Curve& curve : panel.curves) drawSample(svg, curve, 0, y += kLineHeight + 2);
    return;
  }
  svgText(svg, "label strong", 0, top - 9, title);
  double x = 10 + textWidth(title, frame.font + 1);
  if (panel.curves.size() < 2) return;
  for (const Curve& curve : panel.curves) {
    drawSample(svg, curve, x, top - 9);
    x += 44 + textWidth(curve.label, frame.font);
  }
}

}  // namespace

double headingHeight(const ChartFrame& frame) { return frame.wide ? 0 : 24; }

void drawPanel(Html& svg, const ChartFrame& frame, const Axis& x, double top,
               const PlotPanel& panel) {
  const Axis y{panel.y_top, panel.y_bottom, top, top + panel.height};
  drawGrid(svg, x, y, panel.height);
  drawHeading(svg, frame, top, panel);
  for (const Curve& curve : panel.curves) {
    if (curve.filled) svgPath(svg, "area " + curve.css, areaPath(curve.points, x, y, 0));
    svgPath(svg, "curve " + curve.css, linePath(curve.points, x, y));
  }
}

}  // namespace palpa::report

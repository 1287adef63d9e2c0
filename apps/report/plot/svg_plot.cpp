#include "apps/report/plot/svg_plot.h"

#include <algorithm>
#include <cmath>

#include "apps/report/page/page_parts.h"
#include "apps/report/plot/path_data.h"

namespace palpa::report {
namespace {

/// One column's first, lowest, highest and last points, in the order in which they came.
void appendColumn(std::vector<ChartPoint>& line, const std::vector<ChartPoint>& column) {
  if (column.empty()) return;
  const auto [low, high] =
      std::minmax_element(column.begin(), column.end(),
                          [](const ChartPoint& a, const ChartPoint& b) { return a.y < b.y; });
  std::vector<std::ptrdiff_t> keep{0, low - column.begin(), high - column.begin(),
                                   static_cast<std::ptrdiff_t>(column.size()) - 1};
  std::sort(keep.begin(), keep.end());
  keep.erase(std::unique(keep.begin(), keep.end()), keep.end());
  for (const std::ptrdiff_t i : keep) line.push_back(column[static_cast<std::size_t>(i)]);
}

void draw(PathData& path, const std::vector<ChartPoint>& line, const Axis& x, const Axis& y) {
  for (const ChartPoint& p : line) path.lineTo(x.at(p.x), y.at(p.y));
}

}  // namespace

std::vector<std::vector<ChartPoint>> decimated(const std::vector<ChartPoint>& points, const Axis& x,
                                               double column_px) {
  std::vector<std::vector<ChartPoint>> lines;
  std::vector<ChartPoint> line, column;
  double current = 0;
  const auto endLine = [&] {
    appendColumn(line, column);
    column.clear();
    if (!line.empty()) lines.push_back(std::move(line));
    line.clear();
  };
  for (const ChartPoint& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      endLine();
      continue;
    }
    const double index = std::floor(x.at(p.x) / column_px);
    if (!column.empty() && index != current) {
      appendColumn(line, column);
      column.clear();
    }
    current = index;
    column.push_back(p);
  }
  endLine();
  return lines;
}

std::string linePath(const std::vector<ChartPoint>& points, const Axis& x, const Axis& y) {
  PathData path;
  for (const auto& line : decimated(points, x)) {
    path.moveTo(x.at(line.front().x), y.at(line.front().y));
    draw(path, line, x, y);
  }
  return path.str();
}

std::string areaPath(const std::vector<ChartPoint>& points, const Axis& x, const Axis& y,
                     double base) {
  PathData path;
  for (const auto& line : decimated(points, x)) {
    path.lineTo(x.at(line.front().x), y.at(base));
    draw(path, line, x, y);
    path.lineTo(x.at(line.back().x), y.at(base));
    path.close();
  }
  return path.str();
}

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

void drawSample(Html& svg, const PlotCurve& curve, double x, double y) {
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
    for (const PlotCurve& curve : panel.curves) drawSample(svg, curve, 0, y += kLineHeight + 2);
    return;
  }
  svgText(svg, "label strong", 0, top - 9, title);
  double x = 10 + textWidth(title, frame.font + 1);
  if (panel.curves.size() < 2) return;
  for (const PlotCurve& curve : panel.curves) {
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
  for (const PlotCurve& curve : panel.curves) {
    if (curve.filled) svgPath(svg, "area " + curve.css, areaPath(curve.points, x, y, 0));
    svgPath(svg, "curve " + curve.css, linePath(curve.points, x, y));
  }
}

}  // namespace palpa::report

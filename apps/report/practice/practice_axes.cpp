#include "apps/report/practice/practice_axes.h"

#include <algorithm>

#include "apps/report/page/page_parts.h"
#include "apps/report/plot/svg_plot.h"

namespace palpa::report {
namespace {

constexpr double kWhiskerEnd = 5;  // px

}  // namespace

void drawPracticePanel(Html& svg, const ChartFrame& frame, const Axis& x, const std::string& title,
                       const std::string& unit, double top, double bottom) {
  svgText(svg, "label strong", 0, 14, title + ", " + unit);
  drawPanel(svg, frame, x, kPracticeTop, {"", unit, {}, top, bottom, kPracticeHigh});
}

void drawTrialNumbers(Html& svg, const ChartFrame& frame, const Axis& x, double y,
                      std::size_t trials) {
  const std::size_t every =
      1 + trials * (frame.wide ? 34 : 28) / static_cast<std::size_t>(x.to_px - x.from_px);
  svgLine(svg, "axis", x.from_px, y, x.to_px, y);
  for (std::size_t i = 1; i <= trials; ++i) {
    if (i != 1 && i % every != 0) continue;
    svgLine(svg, "axis", x.at(static_cast<double>(i)), y, x.at(static_cast<double>(i)), y + 4);
    if (i == 1 && every == 2) continue;  // 2 is too near
    svgText(svg, "tick mid", x.at(static_cast<double>(i)), y + 18, std::to_string(i));
  }
  svgText(svg, "label mid", (x.from_px + x.to_px) / 2, y + 37, "trial");
}

void drawSessions(Html& svg, const progress::Series& series, const Axis& x, double top,
                  double bottom) {
  for (std::size_t i = 1; i < series.trials.size(); ++i)
    if (series.trials[i].arrival != series.trials[i - 1].arrival)
      svgLine(svg, "session", x.at(static_cast<double>(i) + 0.5), top,
              x.at(static_cast<double>(i) + 0.5), bottom);
}

void drawWhisker(Html& svg, double x1, double y1, double x2, double y2) {
  svgLine(svg, "whisker", x1, y1, x2, y2);
  const double across = x1 == x2 ? kWhiskerEnd : 0, up = x1 == x2 ? 0 : kWhiskerEnd;
  for (const auto& [x, y] : {std::pair{x1, y1}, std::pair{x2, y2}})
    svgLine(svg, "whisker", x - across, y - up, x + across, y + up);
}

void drawDot(Html& svg, const char* css, double x, double y, double radius) {
  svg.empty(
      "circle",
      {{"class", css}, {"cx", coordinate(x)}, {"cy", coordinate(y)}, {"r", coordinate(radius)}});
}

namespace {

constexpr double kPlotRow = 30, kNameRow = 17, kRowsTop = 8, kMeanRadius = 5.5, kValueRadius = 3.2,
                 kNameGap = 14;  // px
constexpr double kWidestNames = 330, kWordsRoom = 92;

double nameRoom(const RowPlot& plot, const ChartFrame& frame) {
  double widest = 100;
  for (const PlotRow& row : plot.rows)
    widest = std::max(widest, textWidth(row.name, frame.font) + kNameGap);
  return std::min(widest, kWidestNames);
}

void drawPlotRow(Html& html, const PlotRow& row, const Axis& x, double y) {
  for (const double value : row.values) drawDot(html, "dot-own", x.at(value), y, kValueRadius);
  if (row.interval) drawWhisker(html, x.at(row.interval->first), y, x.at(row.interval->second), y);
  drawDot(html, "dot-share", x.at(row.mean), y, kMeanRadius);
}

void drawRows(Html& html, const RowPlot& plot, bool wide) {
  ChartFrame frame = practiceFrame(wide);
  const double above = wide ? 0 : kNameRow, high = kPlotRow + above,
               bottom = kRowsTop + high * static_cast<double>(plot.rows.size());
  frame.left = wide ? nameRoom(plot, frame) : 12;
  const Axis x{plot.from, plot.to, frame.left + 8, frame.width - frame.right - kWordsRoom};
  const auto svg = openSvg(html, frame, bottom + 44, plot.label);
  for (std::size_t i = 0; i < plot.rows.size(); ++i)
    svgRect(html, i % 2 ? "row-back odd" : "row-back", 0, kRowsTop + high * static_cast<double>(i),
            frame.width, high);
  for (const double value : niceTicks(plot.from, plot.to, wide ? 10 : 5).values)
    svgLine(html, "grid", x.at(value), kRowsTop, x.at(value), bottom);
  if (plot.middle)
    svgLine(html, "group-mean", x.at(*plot.middle), kRowsTop, x.at(*plot.middle), bottom);
  for (std::size_t i = 0; i < plot.rows.size(); ++i) {
    const PlotRow& row = plot.rows[i];
    const double top = kRowsTop + high * static_cast<double>(i),
                 y = top + above + (high - above) / 2;
    if (wide)
      svgText(html, "label", 4, y + 4, fitted(row.name, frame.left - kNameGap + 6, frame.font));
    else
      svgText(html, "label", 6, top + 14, fitted(row.name, frame.width - 12, frame.font));
    drawPlotRow(html, row, x, y);
    svgText(html, "label", x.to_px + 12, y + 4, row.words);
  }
  drawTimeAxis(html, frame, x, bottom, plot.axis);
}

}  // namespace

void drawRowPlot(Html& html, const RowPlot& plot) {
  drawRows(html, plot, true);
  drawRows(html, plot, false);
}

}  // namespace palpa::report

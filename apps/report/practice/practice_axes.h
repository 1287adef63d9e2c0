#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/assess/progress/history.h"
#include "apps/report/page/html.h"
#include "apps/report/plot/chart_frame.h"

/// What the charts of practice share.
namespace palpa::report {

inline constexpr double kPracticeTop = 36,
                        kPracticeHigh = 190;  // px: of a plot's upper edge, of the plot

/// Room for "12 000" at the left; titles stand above the plot.
inline ChartFrame practiceFrame(bool wide) {
  ChartFrame frame = wide ? kWide : kNarrow;
  frame.left = wide ? 60 : 50;
  return frame;
}

/// Grid and value axis, the title above them.
void drawPracticePanel(Html& svg, const ChartFrame& frame, const Axis& x, const std::string& title,
                       const std::string& unit, double top, double bottom);

inline Axis trialAxis(const ChartFrame& frame, std::size_t trials) {
  return frame.across(0.5, static_cast<double>(std::max<std::size_t>(trials, 2)) + 0.5);
}

/// Whole numbers below the plot.
void drawTrialNumbers(Html& svg, const ChartFrame& frame, const Axis& x, double y,
                      std::size_t trials);

/// Where a new session begins.
void drawSessions(Html& svg, const progress::Series& series, const Axis& x, double top,
                  double bottom);

/// A vertical or horizontal interval with ends.
void drawWhisker(Html& svg, double x1, double y1, double x2, double y2);
void drawDot(Html& svg, const char* css, double x, double y, double radius);

/// A row of a dot plot: its name, its values as hollow dots, their mean with an interval, words at
/// the right.
struct PlotRow {
  std::string name;
  std::vector<double> values;
  double mean = 0;
  std::optional<std::pair<double, double>> interval;
  std::string words;
};

/// Rows over one axis, drawn wide and narrow.
struct RowPlot {
  std::string label;  ///< what a person who cannot see it is told
  std::string axis;   ///< "time, s"
  double from = 0, to = 1;
  std::optional<double> middle;  ///< a line through all rows: the group's mean
  std::vector<PlotRow> rows;
};
void drawRowPlot(Html& html, const RowPlot& plot);

}  // namespace palpa::report

#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "apps/assess/progress/history.h"
#include "apps/report/chart_frame.h"

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

}  // namespace palpa::report

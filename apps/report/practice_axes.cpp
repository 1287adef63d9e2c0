#include "apps/report/practice_axes.h"

#include "apps/report/numbers.h"
#include "apps/report/svg_plot.h"

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

}  // namespace palpa::report

#include "apps/report/palpation/palpation_charts.h"

#include <algorithm>
#include <cmath>

#include "apps/report/page/page_parts.h"
#include "apps/report/plot/svg_plot.h"

namespace palpa::report {
namespace {

constexpr double kMarksHeight = 20, kLineOfText = 13;  // px

PlotPanel pressingPanel(const PalpationPage& page, bool wide) {
  PlotPanel panel{"Force", "N", {}, 1, 0, wide ? 190.0 : 170.0};
  PlotCurve first{"force", "pressing", {}, true},
      second{page.estimated ? "estimated" : "second", "beside", {}, false};
  double high = std::max(page.rules.too_hard, page.rules.levels.back());
  for (const assess::PalpationSample& sample : page.samples) {
    (sample.tool == 0 ? first : second).points.push_back({sample.t_s, sample.f_n});
    if (std::isfinite(sample.f_n)) high = std::max(high, sample.f_n);
  }
  if (!second.points.empty()) first.label = "first";
  panel.curves.push_back(first);
  if (!second.points.empty()) panel.curves.push_back(second);
  panel.y_top = niceCeiling(std::max(1.05 * high, 0.1));
  return panel;
}

/// Start and end of what is drawn.
Axis pressingTime(const PalpationPage& page, const ChartFrame& frame) {
  double from = 0, to = 0;
  for (const assess::PalpationSample& sample : page.samples) {
    if (!std::isfinite(sample.t_s)) continue;
    from = std::min(from, sample.t_s);
    to = std::max(to, sample.t_s);
  }
  return frame.across(from, to > from ? to : from + 1);
}

/// A line at each level with its name above it, where there is room between them.
void drawThresholds(Html& svg, const PalpationPage& page, const Axis& x, const Axis& y) {
  const std::pair<const char*, double> lines[] = {{"light", page.rules.levels[0]},
                                                  {"medium", page.rules.levels[1]},
                                                  {"deep", page.rules.levels[2]},
                                                  {"too hard", page.rules.too_hard}};
  double above = y.to_px + kLineOfText;
  for (std::size_t i = 0; i < 4; ++i) {
    const double at = y.at(lines[i].second);
    svgLine(svg, i < 3 ? "threshold level-" + std::to_string(i + 1) : "threshold hard", x.from_px,
            at, x.to_px, at);
    if (above - at < kLineOfText) continue;
    svgText(svg, "words end", x.to_px - 4, at - 3, lines[i].first);
    above = at;
  }
}

void drawMarkTimes(Html& svg, const PalpationPage& page, const Axis& x, double bottom) {
  for (std::size_t i = 0; i < page.assessment.marks.size(); ++i) {
    const double t = page.assessment.marks[i].t_s;
    if (!(t >= x.from && t <= x.to)) continue;
    svgLine(svg, "moment", x.at(t), kMarksHeight - 4, x.at(t), bottom);
    svgText(svg, "words strong mid", x.at(t), 13, std::to_string(i + 1));
  }
}

void drawPressing(Html& html, const PalpationPage& page, const ChartFrame& frame) {
  const Axis x = pressingTime(page, frame);
  const PlotPanel panel = pressingPanel(page, frame.wide);
  const double top = kMarksHeight + headingHeight(frame) + 4, bottom = top + panel.height;
  const auto svg =
      openSvg(html, frame, bottom + 44,
              "Pressing force in newtons over " + trimmed(x.to - x.from, 1) + " seconds; at most " +
                  trimmed(page.assessment.score.peak, 1) + " N");
  drawPanel(html, frame, x, top, panel);
  drawThresholds(html, page, x, {panel.y_top, 0, top, bottom});
  drawMarkTimes(html, page, x, bottom);
  drawTimeAxis(html, frame, x, bottom + 2, "time since the start of the trial, s");
}

}  // namespace

void writePressingChart(Html& html, const PalpationPage& page) {
  if (page.samples.empty()) return;
  const auto figure = html.in("figure", {{"class", "course"}});
  drawPressing(html, page, kWide);
  drawPressing(html, page, kNarrow);
  const assess::PalpationRules& rules = page.rules;
  html.element("figcaption",
               "Lines: light from " + trimmed(rules.levels[0], 2) + " N, medium from " +
                   trimmed(rules.levels[1], 2) + " N, deep from " + trimmed(rules.levels[2], 2) +
                   " N, too hard above " + trimmed(rules.too_hard, 2) +
                   " N. Numbers on top: the marks, when they were made." +
                   (page.estimated ? " The second finger's force is estimated." : ""));
}

}  // namespace palpa::report

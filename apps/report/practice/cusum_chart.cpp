#include <algorithm>

#include "apps/report/page/page_parts.h"
#include "apps/report/plot/chart_frame.h"
#include "apps/report/plot/svg_plot.h"
#include "apps/report/practice/practice_axes.h"
#include "apps/report/practice/practice_charts.h"

namespace palpa::report {
namespace {

using statistics::CusumVerdict;

constexpr double kCusumMark = 4.6;  // px

const char* wordsOf(CusumVerdict verdict) {
  switch (verdict) {
    case CusumVerdict::acceptable:
      return "acceptable rate accepted";
    case CusumVerdict::unacceptable:
      return "unacceptable rate found";
    case CusumVerdict::undecided:
      break;
  }
  return "undecided";
}

/// From 0 before the first trial, and anew after each verdict.
std::vector<std::vector<ChartPoint>> runsOf(const statistics::Cusum& chart) {
  std::vector<std::vector<ChartPoint>> runs{{{0, 0}}};
  for (std::size_t i = 0; i < chart.sums.size(); ++i) {
    runs.back().push_back({static_cast<double>(i + 1), chart.sums[i]});
    if (chart.verdicts[i] != CusumVerdict::undecided)
      runs.push_back({{static_cast<double>(i + 1), 0}});
  }
  return runs;
}

/// `below`: its words stand under it.
void drawLimit(Html& html, const char* css, const Axis& x, double y, bool below,
               const char* words) {
  svgLine(html, css, x.from_px, y, x.to_px, y);
  svgText(html, "words end tick", x.to_px - 2, below ? y + 15 : y - 6, words);
}

void drawCusum(Html& html, const progress::Series& series, const progress::Competence& c,
               bool wide) {
  const ChartFrame frame = practiceFrame(wide);
  double high = c.limits.h_reject, low = -c.limits.h_accept;
  for (const double sum : c.chart.sums) {
    high = std::max(high, sum);
    low = std::min(low, sum);
  }
  const double top = high + 0.8, bottom = low - 0.8;
  const Axis x = frame.across(0,
                              static_cast<double>(std::max(c.chart.sums.size(), c.minimum)) + 0.5),
             y{top, bottom, kPracticeTop, kPracticeTop + kPracticeHigh};
  const auto svg = openSvg(html, frame, kPracticeTop + kPracticeHigh + 44,
                           "Cumulative sum of failures between its limits");
  drawPracticePanel(html, frame, x, "CUSUM", "sum", top, bottom);
  drawLimit(html, "limit reject", x, y.at(c.limits.h_reject), false,
            "above: unacceptable failure rate");
  drawLimit(html, "limit accept", x, y.at(-c.limits.h_accept), true,
            "below: acceptable failure rate");
  for (const std::vector<ChartPoint>& run : runsOf(c.chart))
    if (run.size() > 1) svgPath(html, "curve sum", linePath(run, x, y));
  for (std::size_t i = 0; i < c.chart.sums.size(); ++i) {
    const Tone tone = progress::failed(series.trials[i]) ? Tone::bad : Tone::good;
    svgPath(html, std::string("mark ") + cssClass(tone),
            markPath(tone, x.at(static_cast<double>(i + 1)), y.at(c.chart.sums[i]), kCusumMark));
  }
  drawTrialNumbers(html, frame, x, y.to_px, std::max(c.chart.sums.size(), c.minimum));
}

}  // namespace

void writeCusumChart(Html& html, const progress::Series& series, const progress::Competence& c) {
  {
    const auto figure = html.in("figure", {{"class", "course"}});
    drawCusum(html, series, c, true);
    drawCusum(html, series, c, false);
    html.element("figcaption", "A failure adds " + fixed(1 - c.limits.s, 3) +
                                   " (diamond), a trial without failure takes " +
                                   fixed(c.limits.s, 3) +
                                   " away (circle). Limits: " + fixed(c.limits.h_accept, 2) +
                                   " below and " + fixed(c.limits.h_reject, 2) +
                                   " above 0; after a limit was crossed the sum begins again. "
                                   "Sequential test of Wald (1947), chances of error 0.1 each.");
  }
  DataTable table{"The figures of this plot", {"Trial", "Failure", "Sum", "So far"}, {}};
  for (std::size_t i = 0; i < c.chart.sums.size(); ++i)
    table.rows.push_back({std::to_string(i + 1), progress::failed(series.trials[i]) ? "yes" : "no",
                          fixed(c.chart.sums[i], 3), wordsOf(c.chart.verdicts[i])});
  writeDataTable(html, table);
}

}  // namespace palpa::report

#include "apps/report/practice/practice_charts.h"
#include "apps/training/engine.h"

#include <algorithm>
#include <cmath>

#include "apps/assess/progress/learning_curve.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/plot/chart_frame.h"
#include "apps/report/plot/path_data.h"
#include "apps/report/plot/svg_plot.h"
#include "apps/report/practice/practice_axes.h"
#include "apps/report/practice/progress_words.h"

namespace palpa::report {
namespace {

constexpr double kPracticeMark = 5.5, kShareRadius = 5.5;  // px
constexpr std::size_t kManyTrials = 120;  // beyond them marks would cover each other

std::vector<ChartPoint> pointsOf(const std::vector<double>& values, double factor) {
  std::vector<ChartPoint> points;
  for (std::size_t i = 0; i < values.size(); ++i)
    points.push_back({static_cast<double>(i + 1), factor * values[i]});
  return points;
}

/// Closed outline between two lines over trials 1 ... N.
std::string bandPath(const std::vector<double>& low, const std::vector<double>& high, double factor,
                     const Axis& x, const Axis& y) {
  PathData path;
  const auto add = [&](std::size_t i, double value) {
    path.lineTo(x.at(static_cast<double>(i + 1)),
                std::clamp(y.at(factor * value), y.from_px, y.to_px));
  };
  for (std::size_t i = 0; i < high.size(); ++i) add(i, high[i]);
  for (std::size_t i = low.size(); i-- > 0;) add(i, low[i]);
  path.close();
  return path.str();
}

/// Round limits that hold every value, with 0 where it is near.
std::pair<double, double> limitsOf(const std::vector<double>& values, double factor) {
  double low = 0, high = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, factor * value);
    high = std::max(high, factor * value);
  }
  return {high > 0 ? niceCeiling(high) : 0.1 * niceCeiling(-low), low < 0 ? -niceCeiling(-low) : 0};
}

struct LearningPlot {
  std::string metric;
  std::vector<double> values;
  std::optional<progress::LearningCurve> curve;
};

void drawLearning(Html& html, const progress::Series& series, const LearningPlot& plot, bool wide) {
  const ChartFrame frame = practiceFrame(wide);
  const auto [factor, unit] = scaleOf(plot.metric);
  const auto [top, bottom] = limitsOf(plot.values, factor);
  const Axis x = trialAxis(frame, plot.values.size());
  const std::string title = metrics::metricNamed(plot.metric)->title;
  const auto svg =
      openSvg(html, frame, kPracticeTop + kPracticeHigh + 44, title + " of each trial");
  drawPracticePanel(html, frame, x, title, unit.empty() ? "number" : unit, top, bottom);
  const Axis y{top, bottom, kPracticeTop, kPracticeTop + kPracticeHigh};
  drawSessions(html, series, x, y.from_px, y.to_px);
  if (plot.curve) {
    svgPath(html, "band", bandPath(plot.curve->low, plot.curve->high, factor, x, y));
    svgPath(html, "curve fitted", linePath(pointsOf(plot.curve->fitted, factor), x, y));
  }
  const double radius = plot.values.size() > kManyTrials || !wide ? 4 : kPracticeMark;
  for (std::size_t i = 0; i < plot.values.size(); ++i) {
    if (!std::isfinite(plot.values[i])) continue;
    const Tone tone = toneOfPractice(series.trials[i]);
    svgPath(
        html, std::string("mark ") + cssClass(tone),
        markPath(tone, x.at(static_cast<double>(i + 1)), y.at(factor * plot.values[i]), radius));
  }
  drawTrialNumbers(html, frame, x, y.to_px, plot.values.size());
}

std::string curveWords(const LearningPlot& plot) {
  if (!plot.curve)
    return "Fewer than " + std::to_string(progress::kFewestForCurve) +
           " trials, or nothing that varies: no curve is fitted. ";
  const progress::LearningCurve& c = *plot.curve;
  std::string words =
      "Line: exponential curve fitted to the trials, with the band that holds it in 95 of 100 "
      "draws of the residuals (bootstrap). ";
  if (!c.changed())
    return words +
           "By this curve no change is certain (95 %: " + figureOf(plot.metric, c.change_low) +
           " to " + figureOf(plot.metric, c.change_high) + "). ";
  return words + "From the first to the last trial it goes from " +
         figureOf(plot.metric, c.fitted.front()) + " to " + figureOf(plot.metric, c.fitted.back()) +
         " (change, 95 %: " + figureOf(plot.metric, c.change_low) + " to " +
         figureOf(plot.metric, c.change_high) + "). ";
}

std::string shortDate(const std::string& utc) { return utc.substr(0, 10); }

DataTable learningTable(const progress::Series& series, const LearningPlot& plot) {
  const auto [factor, unit] = scaleOf(plot.metric);
  const std::string name =
      metrics::metricNamed(plot.metric)->title + (unit.empty() ? std::string() : ", " + unit);
  DataTable table{"The figures of this plot", {"Trial", "Session", "Success", name}, {}};
  if (plot.curve) table.columns.insert(table.columns.end(), {"curve", "band from", "to"});
  for (std::size_t i = 0; i < plot.values.size(); ++i) {
    table.rows.push_back({std::to_string(i + 1), shortDate(series.trials[i].started_utc),
                          series.trials[i].succeeded() ? "yes" : "no",
                          trimmed(factor * plot.values[i], 2)});
    if (plot.curve)
      for (const std::vector<double>* line :
           {&plot.curve->fitted, &plot.curve->low, &plot.curve->high})
        table.rows.back().push_back(trimmed(factor * (*line)[i], 2));
  }
  return table;
}

void drawSuccess(Html& html, const std::vector<progress::SuccessBlock>& blocks, std::size_t trials,
                 bool wide) {
  const ChartFrame frame = practiceFrame(wide);
  const Axis x = trialAxis(frame, trials), y{100, 0, kPracticeTop, kPracticeTop + kPracticeHigh};
  const auto svg = openSvg(html, frame, kPracticeTop + kPracticeHigh + 44,
                           "Share of successes in blocks of trials");
  drawPracticePanel(html, frame, x, "Success", "%", 100, 0);
  for (const progress::SuccessBlock& block : blocks) {
    const double middle = x.at(0.5 * static_cast<double>(block.from + block.to));
    drawWhisker(html, middle, y.at(100 * block.share.low), middle, y.at(100 * block.share.high));
    drawDot(html, "dot-share", middle, y.at(100 * block.share.share), kShareRadius);
  }
  drawTrialNumbers(html, frame, x, y.to_px, trials);
}

}  // namespace

Tone toneOfPractice(const progress::PracticeTrial& trial) {
  if (!progress::failed(trial)) return Tone::good;
  return trial.succeeded() ? Tone::guide : Tone::bad;
}

void writeLearningChart(Html& html, const progress::Series& series, const std::string& metric) {
  const LearningPlot plot{metric, series.values(metric),
                          progress::learningCurve(series.values(metric))};
  if (std::none_of(plot.values.begin(), plot.values.end(),
                   [](double v) { return std::isfinite(v); }))
    return;
  {
    const auto figure = html.in("figure", {{"class", "course"}});
    drawLearning(html, series, plot, true);
    drawLearning(html, series, plot, false);
    const std::string square = series.engine == training::Engine::needle
                                   ? "square: success, but lung or artery was touched or there "
                                     "were more than three passes; "
                                   : "";
    html.element("figcaption", curveWords(plot) + "Circle: success; " + square +
                                   "diamond: no success. Dotted: a new session.");
  }
  writeDataTable(html, learningTable(series, plot));
}

void writeSuccessChart(Html& html, const progress::Series& series) {
  std::vector<bool> successes;
  for (const progress::PracticeTrial& trial : series.trials) successes.push_back(trial.succeeded());
  const std::vector<progress::SuccessBlock> blocks = progress::successBlocks(successes);
  if (blocks.empty()) return;
  {
    const auto figure = html.in("figure", {{"class", "course"}});
    drawSuccess(html, blocks, successes.size(), true);
    drawSuccess(html, blocks, successes.size(), false);
    html.element("figcaption",
                 "Share of trials with success in blocks of five, in their order; the bars are 95 "
                 "% intervals (Wilson 1927).");
  }
  DataTable table{
      "The figures of this plot", {"Trials", "Successes", "Share, %", "95 % from", "to"}, {}};
  for (const progress::SuccessBlock& b : blocks)
    table.rows.push_back({std::to_string(b.from) + " to " + std::to_string(b.to),
                          std::to_string(b.hits) + " of " + std::to_string(b.of),
                          fixed(100 * b.share.share, 0), fixed(100 * b.share.low, 0),
                          fixed(100 * b.share.high, 0)});
  writeDataTable(html, table);
}

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

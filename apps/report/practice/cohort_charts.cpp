#include "apps/report/practice/practice_charts.h"

#include <algorithm>
#include <cmath>

#include "apps/assess/statistics/sample.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/plot/path_data.h"
#include "apps/report/plot/svg_plot.h"
#include "apps/report/practice/practice_axes.h"
#include "apps/report/practice/progress_words.h"

namespace palpa::report {
namespace {

std::string intervalField(const std::optional<std::pair<double, double>>& interval, double factor) {
  return interval
             ? fixed(factor * interval->first, 1) + " to " + fixed(factor * interval->second, 1)
             : "–";
}

std::string axisWords(const std::string& metric) {
  const std::string unit = scaleOf(metric).second;
  return titleWithin(metric) + (unit.empty() ? "" : ", " + unit);
}

std::pair<double, double> scaled(const std::pair<double, double>& interval, double factor) {
  return {factor * interval.first, factor * interval.second};
}

/// Round limits around all values and intervals.
void fitAxis(RowPlot& plot) {
  double low = 0, high = 0;
  for (const PlotRow& row : plot.rows) {
    for (const double value : row.values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (row.interval) high = std::max(high, row.interval->second);
  }
  plot.to = high > 0 ? niceCeiling(high) : 1;
  plot.from = low < 0 ? -niceCeiling(-low) : 0;
}

ChartPoint pointAt(std::size_t trial, double value) {
  return {static_cast<double>(trial + 1), value};
}

/// Upper edge there, lower edge back.
std::string meanBand(const progress::GroupCurve& curve, double factor, const Axis& x,
                     const Axis& y) {
  PathData path;
  const auto add = [&](std::size_t i, double value) {
    path.lineTo(x.at(static_cast<double>(i + 1)),
                std::clamp(y.at(factor * value), y.from_px, y.to_px));
  };
  for (std::size_t i = 0; i < curve.mean.size(); ++i)
    add(i, curve.mean[i].interval ? curve.mean[i].interval->second : curve.mean[i].mean);
  for (std::size_t i = curve.mean.size(); i-- > 0;)
    add(i, curve.mean[i].interval ? curve.mean[i].interval->first : curve.mean[i].mean);
  if (!curve.mean.empty()) path.close();
  return path.str();
}

void drawGroupCurve(Html& html, const progress::GroupCurve& curve, const std::string& metric,
                    bool wide) {
  const ChartFrame frame = practiceFrame(wide);
  const auto [factor, unit] = scaleOf(metric);
  std::size_t longest = 0;
  double high = 0;
  for (const std::vector<double>& own : curve.curves) {
    longest = std::max(longest, own.size());
    for (const double value : own)
      if (std::isfinite(value)) high = std::max(high, factor * value);
  }
  const Axis x = trialAxis(frame, longest),
             y{niceCeiling(high), 0, kPracticeTop, kPracticeTop + kPracticeHigh};
  const std::string title = metrics::metricNamed(metric)->title;
  const auto svg = openSvg(html, frame, kPracticeTop + kPracticeHigh + 44,
                           title + " of every trainee, and the group's mean");
  drawPracticePanel(html, frame, x, title, unit.empty() ? "number" : unit, y.from, 0);
  for (const std::vector<double>& own : curve.curves) {
    std::vector<ChartPoint> points;
    for (std::size_t i = 0; i < own.size(); ++i) points.push_back(pointAt(i, factor * own[i]));
    svgPath(html, "curve own", linePath(points, x, y));
  }
  if (!curve.mean.empty()) {
    std::vector<ChartPoint> mean;
    for (std::size_t i = 0; i < curve.mean.size(); ++i)
      mean.push_back(pointAt(i, factor * curve.mean[i].mean));
    svgPath(html, "band", meanBand(curve, factor, x, y));
    svgPath(html, "curve fitted", linePath(mean, x, y));
  }
  drawTrialNumbers(html, frame, x, y.to_px, longest);
}

}  // namespace

void writeCommonErrors(Html& html, const std::vector<progress::CommonError>& errors) {
  if (errors.empty()) {
    html.element("p", "None of the errors that figures can tell happened.");
    return;
  }
  RowPlot plot{"Share of a trainee's trials with each error",
               "share of a trainee's trials, %",
               0,
               100,
               {},
               {}};
  DataTable table{
      "The figures of this plot", {"Error", "Trainees", "Trials", "Mean share, %", "95 %"}, {}};
  for (const progress::CommonError& e : errors) {
    const std::string trainees =
        std::to_string(e.trainees_with) + " of " + std::to_string(e.trainees);
    const auto interval =
        e.share.interval ? std::optional(scaled(*e.share.interval, 100)) : std::nullopt;
    plot.rows.push_back({e.kind->words, {}, 100 * e.share.mean, interval, trainees});
    table.rows.push_back({e.kind->words, trainees,
                          std::to_string(e.with) + " of " + std::to_string(e.trials),
                          fixed(100 * e.share.mean, 0), intervalField(e.share.interval, 100)});
  }
  {
    const auto figure = html.in("figure", {{"class", "course"}});
    drawRowPlot(html, plot);
    html.element("figcaption",
                 "Mean over the trainees of the share of each one's trials, with its 95 % interval "
                 "(bootstrap over trainees; none for fewer than three). At the right: how many "
                 "trainees it happened to.");
  }
  writeDataTable(html, table);
}

void writeTraineeFigures(Html& html, const progress::Series& group, const std::string& metric) {
  const std::vector<progress::TraineeFigure> figures = progress::traineeFigures(group, metric);
  if (figures.empty()) return;
  const double factor = scaleOf(metric).first;
  RowPlot plot{axisWords(metric) + " of every trainee", axisWords(metric), 0, 1, {}, {}};
  DataTable table{"The figures of this plot", {"Trainee", "Trials", "Mean", "95 %"}, {}};
  std::vector<double> means;
  for (const progress::TraineeFigure& f : figures) {
    PlotRow row{f.trainee, {}, factor * f.mean, {}, figureOf(metric, f.mean)};
    for (const double value : f.values) row.values.push_back(factor * value);
    if (f.interval) row.interval = scaled(*f.interval, factor);
    plot.rows.push_back(std::move(row));
    table.rows.push_back({f.trainee, std::to_string(f.values.size()), trimmed(factor * f.mean, 2),
                          intervalField(f.interval, factor)});
    means.push_back(factor * f.mean);
  }
  plot.middle = statistics::meanOf(means);
  fitAxis(plot);
  html.element("h4", metrics::metricNamed(metric)->title);
  {
    const auto figure = html.in("figure", {{"class", "course"}});
    drawRowPlot(html, plot);
    html.element(
        "figcaption",
        "Small rings: each trainee's last trials, up to five; dot and bar: their mean and its 95 % "
        "interval (bootstrap over these trials). Dashed: mean of the trainees' means.");
  }
  writeDataTable(html, table);
}

void writeGroupCurve(Html& html, const progress::GroupCurve& curve, const std::string& metric) {
  if (std::none_of(curve.curves.begin(), curve.curves.end(), [](const auto& own) {
        return std::any_of(own.begin(), own.end(), [](double v) { return std::isfinite(v); });
      }))
    return;
  {
    const auto figure = html.in("figure", {{"class", "course"}});
    drawGroupCurve(html, curve, metric, true);
    drawGroupCurve(html, curve, metric, false);
    html.element(
        "figcaption",
        std::string("Thin lines: one a trainee. ") +
            (curve.mean.empty()
                 ? "With fewer than three trainees no mean is drawn."
                 : "Thick: the group's mean at each trial that at least three and half of the "
                   "trainees have done, with its 95 % interval (bootstrap over trainees)."));
  }
  const double factor = scaleOf(metric).first;
  DataTable table{"The figures of this plot", {"Trial", "Trainees", "Mean", "95 %"}, {}};
  for (std::size_t i = 0; i < curve.mean.size(); ++i)
    table.rows.push_back({std::to_string(i + 1), std::to_string(curve.mean[i].trainees),
                          trimmed(factor * curve.mean[i].mean, 2),
                          intervalField(curve.mean[i].interval, factor)});
  writeDataTable(html, table);
}

}  // namespace palpa::report

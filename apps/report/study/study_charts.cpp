#include "apps/report/study/study_exhibits.h"

#include <algorithm>
#include <cmath>

#include "apps/report/page/page_parts.h"
#include "apps/report/plot/path_data.h"
#include "apps/report/plot/svg_plot.h"

namespace palpa::report {
namespace {

using study_analysis::Plot;
using study_analysis::PlotKind;
using study_analysis::PlotPoint;
using study_analysis::PlotSeries;

constexpr std::string_view kStudyChartStyle = R"css(
svg .study-line{fill:none;stroke-width:2;stroke-linejoin:round}
svg .study-band{stroke:none;fill-opacity:.15}
svg .study-mark{stroke-width:1.6}
svg .study-bar{fill-opacity:.8;stroke:var(--card)}
svg .study-whisker{stroke:var(--ink);stroke-width:1.6}
svg .study-divider{stroke:var(--muted);stroke-dasharray:2 4}
svg .study-line.family-0{stroke:var(--blue)}
svg .study-line.family-1{stroke:var(--bad);stroke-dasharray:8 4}
svg .study-line.family-2{stroke:var(--good);stroke-dasharray:2 4}
svg .study-line.family-3{stroke:var(--plain);stroke-dasharray:10 3 2 3}
svg .study-band.family-0,svg .study-bar.family-0{fill:var(--blue)}
svg .study-band.family-1,svg .study-bar.family-1{fill:var(--bad)}
svg .study-band.family-2,svg .study-bar.family-2{fill:var(--good)}
svg .study-band.family-3,svg .study-bar.family-3{fill:var(--plain)}
svg .study-mark.family-0{fill:var(--blue);stroke:var(--card)}
svg .study-mark.family-1{fill:var(--bad);stroke:var(--card)}
svg .study-mark.family-2{fill:var(--good);stroke:var(--card)}
svg .study-mark.family-3{fill:var(--card);stroke:var(--plain)}
)css";

std::vector<ChartPoint> pointsOf(const PlotSeries& s, double PlotPoint::*of) {
  std::vector<ChartPoint> points;
  for (const PlotPoint& p : s.points) points.push_back({p.x, p.*of});
  return points;
}

/// From the low ends to the right and over the high ends back.
void drawBand(Html& svg, const StudyArea& area, const PlotSeries& s) {
  PathData path;
  const auto to = [&](double x, double y) { path.lineTo(area.x.at(x), area.y.at(y)); };
  for (const PlotPoint& p : s.points) to(p.x, p.low);
  for (auto p = s.points.rbegin(); p != s.points.rend(); ++p) to(p->x, p->high);
  if (s.points.empty()) return;
  path.close();
  svgPath(svg, "study-band " + familyClass(s.family), path.str());
}

void drawDividers(Html& svg, const StudyArea& area, const Plot& plot) {
  for (const study_analysis::PlotDivider& divider : plot.dividers) {
    const double x = std::max(area.x.from_px, area.x.at(divider.x));
    svgLine(svg, "study-divider", x, area.top - 16, x, area.bottom);
    svgText(svg, "tick", x + 4, area.top - 8, divider.label);
  }
}

double lastX(const Plot& plot) {
  double last = 1;
  for (const PlotSeries& s : plot.series)
    for (const PlotPoint& p : s.points) last = std::max(last, p.x);
  return last;
}

void drawCurves(Html& html, const Plot& plot, const ChartFrame& frame, const std::string& label) {
  const StudyArea area = studyArea(frame, plot, 0.5, lastX(plot) + 0.5, studyRange(plot, true));
  const auto svg = openSvg(html, frame, area.height, label);
  drawStudyAxes(html, area, plot);
  drawDividers(html, area, plot);
  for (const PlotSeries& s : plot.series) drawBand(html, area, s);
  for (const PlotSeries& s : plot.series) {
    svgPath(html, "study-line " + familyClass(s.family),
            linePath(pointsOf(s, &PlotPoint::y), area.x, area.y));
    for (const PlotPoint& p : s.points)
      drawStudyMark(html, s.family, area.x.at(p.x), area.y.at(p.y));
  }
  drawTimeAxis(html, frame, area.x, area.bottom, plot.x_title);
}

void drawNames(Html& svg, const StudyArea& area, const std::vector<std::string>& names,
               double room) {
  svgLine(svg, "axis", area.x.from_px, area.bottom, area.x.to_px, area.bottom);
  for (std::size_t i = 0; i < names.size(); ++i)
    svgText(svg, "tick mid", area.x.at(static_cast<double>(i)), area.bottom + 18,
            fitted(names[i], room, area.frame.font));
}

void drawBars(Html& html, const Plot& plot, const ChartFrame& frame, const std::string& label) {
  const StudyArea area = studyArea(
      frame, plot, -0.5, static_cast<double>(plot.x_names.size()) - 0.5, studyRange(plot, true));
  const auto svg = openSvg(html, frame, area.height, label);
  drawStudyAxes(html, area, plot);
  const double slot = area.x.at(1) - area.x.at(0),
               width = std::min(
                   90.0,
                   0.7 * slot / static_cast<double>(std::max<std::size_t>(1, plot.series.size())));
  const double zero = area.y.at(std::max(0.0, area.y.from));
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    for (const PlotPoint& p : plot.series[i].points) {
      const double left = area.x.at(p.x) + width * (static_cast<double>(i) -
                                                    static_cast<double>(plot.series.size()) / 2),
                   middle = left + width / 2, high = area.y.at(p.y);
      svgRect(html, "study-bar " + familyClass(plot.series[i].family), left, std::min(high, zero),
              width, std::abs(zero - high));
      svgLine(html, "study-whisker", middle, area.y.at(p.low), middle, area.y.at(p.high));
      for (const double end : {p.low, p.high})
        svgLine(html, "study-whisker", middle - 6, area.y.at(end), middle + 6, area.y.at(end));
      drawStudyMark(html, plot.series[i].family, middle, high);
    }
  drawNames(html, area, plot.x_names, slot - 10);
}

/// A panel a family, beside each other.
void drawSlopes(Html& html, const Plot& plot, const ChartFrame& frame, const std::string& label) {
  Plot without_key = plot;
  without_key.families.clear();
  without_key.dividers.assign(1, {});  // room for the panels' names
  const auto panels = static_cast<double>(std::max<std::size_t>(1, plot.families.size()));
  const StudyArea area =
      studyArea(frame, without_key, -0.3, 2 * panels - 0.7, studyRange(plot, true));
  const auto svg = openSvg(html, frame, area.height, label);
  without_key.dividers.clear();
  drawStudyAxes(html, area, without_key);
  std::vector<std::string> names;
  for (std::size_t f = 0; f < plot.families.size(); ++f) {
    names.insert(names.end(), plot.x_names.begin(), plot.x_names.end());
    const double from = 2 * static_cast<double>(f);
    svgText(html, "label mid", area.x.at(from + 0.5), area.top - 8,
            fitted(plot.families[f], 1.6 * (area.x.at(1) - area.x.at(0)), frame.font));
    if (f > 0)
      svgLine(html, "study-divider", area.x.at(from - 0.5), area.top, area.x.at(from - 0.5),
              area.bottom);
  }
  for (const PlotSeries& s : plot.series) {
    PlotSeries shifted = s;
    for (PlotPoint& p : shifted.points) p.x += 2 * s.family;
    svgPath(html, "study-line " + familyClass(s.family),
            linePath(pointsOf(shifted, &PlotPoint::y), area.x, area.y));
    for (const PlotPoint& p : shifted.points)
      drawStudyMark(html, s.family, area.x.at(p.x), area.y.at(p.y));
  }
  drawNames(html, area, names, area.x.at(1) - area.x.at(0) - 4);
}

void drawScatter(Html& html, const Plot& plot, const ChartFrame& frame, const std::string& label) {
  double low = 0, high = 0;
  for (const PlotSeries& s : plot.series)
    for (const PlotPoint& p : s.points) {
      low = std::min(low, p.x);
      high = std::max(high, p.x);
    }
  const double room = high > low ? 0.06 * (high - low) : 1;
  const StudyArea area = studyArea(frame, plot, low - room, high + room, studyRange(plot, true));
  const auto svg = openSvg(html, frame, area.height, label);
  drawStudyAxes(html, area, plot);
  svgLine(html, "zero", area.x.at(0), area.top, area.x.at(0), area.bottom);
  for (const PlotSeries& s : plot.series)
    for (const PlotPoint& p : s.points)
      drawStudyMark(html, s.family, area.x.at(p.x), area.y.at(p.y));
  drawTimeAxis(html, frame, area.x, area.bottom, plot.x_title);
}

}  // namespace

void writeStudyPlot(Html& html, const Plot& plot, const std::string& label) {
  const auto draw = plot.kind == PlotKind::curves   ? drawCurves
                    : plot.kind == PlotKind::bars   ? drawBars
                    : plot.kind == PlotKind::slopes ? drawSlopes
                                                    : drawScatter;
  const std::string spoken = label + ": " + plot.y_title;
  for (const ChartFrame& frame : {kWide, kNarrow}) draw(html, plot, frame, spoken);
}

std::string_view studyChartStyle() { return kStudyChartStyle; }

}  // namespace palpa::report

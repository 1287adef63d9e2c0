#include "apps/report/study/study_exhibits.h"

#include <algorithm>
#include <cmath>

#include "apps/report/page/page_parts.h"
#include "apps/report/plot/chart_frame.h"

namespace palpa::report {
namespace {

constexpr double kStudyWideHigh = 250, kStudyNarrowHigh = 200, kStudyKeyLine = 22,
                 kStudyTitleLine = 22, kStudyBelow = 46, kStudyLeft = 66,
                 kStudyNarrowLeft = 52;  // px
constexpr double kStudyMark = 4.6;
constexpr int kStudyFamilies = 4;  // drawn differently

struct KeyPlace {
  double x = 0, y = 0;
};

/// The key from left to right, in as many lines as it takes.
std::vector<KeyPlace> keyPlaces(const ChartFrame& frame, const std::vector<std::string>& families,
                                double left) {
  std::vector<KeyPlace> places;
  KeyPlace at{left, 0};
  for (const std::string& name : families) {
    const double width = 44 + textWidth(name, frame.font);
    if (at.x > left && at.x + width > frame.width - frame.right) at = {left, at.y + kStudyKeyLine};
    places.push_back(at);
    at.x += width + 14;
  }
  return places;
}

double keyHeight(const ChartFrame& frame, const study_analysis::Plot& plot, double left) {
  if (plot.families.size() < 2) return 0;
  return keyPlaces(frame, plot.families, left).back().y + kStudyKeyLine;
}

void drawStudyKey(Html& svg, const StudyArea& area, const study_analysis::Plot& plot) {
  if (plot.families.size() < 2) return;
  const std::vector<KeyPlace> places = keyPlaces(area.frame, plot.families, area.x.from_px);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double y = 14 + places[i].y;
    const int family = static_cast<int>(i);
    if (plot.kind != study_analysis::PlotKind::scatter)
      svgLine(svg, "study-line " + familyClass(family), places[i].x, y - 4, places[i].x + 26,
              y - 4);
    drawStudyMark(svg, family, places[i].x + 13, y - 4);
    svgText(svg, "legend", places[i].x + 33, y,
            fitted(plot.families[i], area.frame.width - places[i].x - 40, area.frame.font));
  }
}

}  // namespace

StudyRange studyRange(const study_analysis::Plot& plot, bool zero) {
  double low = INFINITY, high = -INFINITY;
  for (const study_analysis::PlotSeries& s : plot.series)
    for (const study_analysis::PlotPoint& p : s.points)
      for (const double v : {p.y, p.low, p.high})
        if (std::isfinite(v)) {
          low = std::min(low, v);
          high = std::max(high, v);
        }
  if (!(low <= high)) return {0, 1};
  if (zero) low = std::min(0.0, low);
  const double room = high > low ? (high - low) * 0.05 : std::max(1.0, std::abs(high)) * 0.1;
  return {low < 0 || !zero ? low - room : 0, high + room};
}

StudyArea studyArea(const ChartFrame& frame, const study_analysis::Plot& plot, double from,
                    double to, const StudyRange& range) {
  StudyArea area;
  area.frame = frame;
  const double left = frame.wide ? kStudyLeft : kStudyNarrowLeft;
  area.top =
      keyHeight(frame, plot, left) + kStudyTitleLine + (plot.dividers.empty() ? 0 : kStudyKeyLine);
  area.bottom = area.top + (frame.wide ? kStudyWideHigh : kStudyNarrowHigh);
  area.height = area.bottom + kStudyBelow;
  area.x = {from, to, left, frame.width - frame.right};
  area.y = {range.low, range.high, area.bottom, area.top};
  return area;
}

void drawStudyAxes(Html& svg, const StudyArea& area, const study_analysis::Plot& plot) {
  drawStudyKey(svg, area, plot);
  svgText(svg, "label strong", 0, keyHeight(area.frame, plot, area.x.from_px) + 13, plot.y_title);
  const Ticks ticks = niceTicks(area.y.from, area.y.to, area.frame.wide ? 8 : 6);
  for (const double value : ticks.values) {
    svgLine(svg, value == 0 ? "zero" : "grid", area.x.from_px, area.y.at(value), area.x.to_px,
            area.y.at(value));
    svgText(svg, "tick end", area.x.from_px - 7, area.y.at(value) + 4, ticks.label(value));
  }
}

void drawStudyMark(Html& svg, int family, double x, double y) {
  const int kind = family % kStudyFamilies;
  const Tone tone = kind == 1 ? Tone::guide : kind == 2 ? Tone::bad : Tone::neutral;
  svgPath(svg, "study-mark " + familyClass(family), markPath(tone, x, y, kStudyMark));
}

std::string familyClass(int family) { return "family-" + std::to_string(family % kStudyFamilies); }

}  // namespace palpa::report

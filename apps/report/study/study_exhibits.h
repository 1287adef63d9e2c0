#pragma once

#include <string>
#include <vector>

#include "apps/report/page/html.h"
#include "apps/report/plot/chart_frame.h"
#include "apps/study/analysis/exhibit.h"

namespace palpa::report {

/// A table of a study for readers; scrolls where it is wider than the page.
void writeStudyTable(Html& html, const study_analysis::Table& table);

/// A number as its column wants it: decimals, "< 0.001" for small p-values, "–" for what does not
/// apply.
std::string studyCell(const study_analysis::Cell& cell, const study_analysis::Column& column);

std::string studyCsv(const study_analysis::Table& table, bool simulated);
std::string studyJson(const study_analysis::Exhibit& exhibit, bool simulated);

}  // namespace palpa::report

/// What the plots of a study share: the place, the values' axis, the key.
namespace palpa::report {

/// Where a plot lies in its picture.
struct StudyArea {
  ChartFrame frame;
  Axis x, y;                               ///< y.from_px: the lower edge
  double top = 0, bottom = 0, height = 0;  ///< height: of the whole picture
};

/// Lowest and highest of all points and intervals; `zero`: from zero, where nothing is below.
struct StudyRange {
  double low = 0, high = 1;
};
StudyRange studyRange(const study_analysis::Plot& plot, bool zero);

/// Room for the key and both titles around a plot whose x reaches from `from` to `to`.
StudyArea studyArea(const ChartFrame& frame, const study_analysis::Plot& plot, double from,
                    double to, const StudyRange& range);

/// Lines and numbers of the values, their title, the key of families.
void drawStudyAxes(Html& svg, const StudyArea& area, const study_analysis::Plot& plot);

/// A mark of a family: circle, square, diamond, hollow circle, in this order.
void drawStudyMark(Html& svg, int family, double x, double y);

/// "family-0" ... "family-3", and over again.
std::string familyClass(int family);

/// A plot of a study's results, wide and narrow: means over trials with bands, bars with intervals,
/// a line a subject, a mark a subject. Groups and conditions differ in dash and shape as well as
/// colour.
void writeStudyPlot(Html& html, const study_analysis::Plot& plot, const std::string& label);

/// CSS of these plots.
std::string_view studyChartStyle();

}  // namespace palpa::report

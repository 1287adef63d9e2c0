#pragma once

#include <string>
#include <vector>

#include "apps/report/axis.h"
#include "apps/report/chart_frame.h"
#include "apps/report/html.h"
#include "apps/study_analysis/exhibit.h"

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

}  // namespace palpa::report

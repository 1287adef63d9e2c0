#pragma once

#include <string_view>

#include "apps/report/axis.h"
#include "apps/report/html.h"

namespace palpa::report {

/// Every chart is drawn twice: wide for desks and paper, narrow for telephones; the style sheet
/// shows one of them. So type stays legible without a script.
struct ChartFrame {
  bool wide = true;
  double width = 960;
  double left = 140;  ///< titles and lane names stand here in the wide form
  double right = 18;
  double font = 13;

  Axis across(double from, double to) const { return {from, to, left, width - right}; }
};

inline constexpr ChartFrame kWide{};
inline constexpr ChartFrame kNarrow{false, 400, 42, 10, 12};

/// Estimated width of text in a sans-serif face, px; on the safe side.
double textWidth(std::string_view text, double font);

/// `text` cut to `room` px, with an ellipsis.
std::string fitted(std::string_view text, double room, double font);

/// Opens <svg> with role, label and view box; close by leaving the scope.
Html::Scope openSvg(Html& html, const ChartFrame& frame, double height, std::string_view label);

void svgLine(Html& svg, std::string_view css, double x1, double y1, double x2, double y2);
void svgRect(Html& svg, std::string_view css, double x, double y, double width, double height);
void svgText(Html& svg, std::string_view css, double x, double y, std::string_view text);
void svgPath(Html& svg, std::string_view css, std::string_view d);

/// Tick marks, labels and the title of a horizontal axis below `y`.
void drawTimeAxis(Html& svg, const ChartFrame& frame, const Axis& x, double y,
                  std::string_view title);

}  // namespace palpa::report

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/report/page/html.h"
#include "apps/report/page/style.h"

namespace palpa::report {

/// A stretch of numbers shown on a stretch of the picture; `from_px` may be the larger one.
struct Axis {
  double from = 0, to = 1;        ///< data
  double from_px = 0, to_px = 1;  ///< picture
  double at(double value) const {
    return from_px + (value - from) / (to - from) * (to_px - from_px);
  }
};

struct Ticks {
  std::vector<double> values;
  int decimals = 0;  ///< enough to tell neighbours apart
  std::string label(double value) const;
};

/// Round values in [from, to]: multiples of 1, 2 or 5 times a power of ten, at most `most` of them
/// (`most` >= 2), as many as fit. Zero is among them if it lies within.
Ticks niceTicks(double from, double to, int most);

/// The smallest round number not below `value` (> 0): where an axis that starts at zero may end.
double niceCeiling(double value);

/// Outline of a mark about (x, y), for an SVG path. Shapes differ besides colour: circle (neutral
/// or good), square (guide), diamond (bad); of about equal area.
std::string markPath(Tone tone, double x, double y, double radius);

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

/// How much longer a text may be that is said in another language.
inline constexpr double kLongerElsewhere = 1.4;

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

#include "apps/report/chart_frame.h"

#include <algorithm>

#include "apps/report/numbers.h"

namespace palpa::report {
namespace {

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

}  // namespace

double textWidth(std::string_view text, double font) {
  const auto letters =
      std::count_if(text.begin(), text.end(), [](char c) { return !continues(c); });
  return 0.56 * font * static_cast<double>(letters);  // DejaVu Sans, the widest of the usual faces
}

std::string fitted(std::string_view text, double room, double font) {
  if (textWidth(text, font) <= room) return std::string(text);
  while (!text.empty() && textWidth(text, font) > room - font) {
    do text.remove_suffix(1);
    while (!text.empty() && continues(text.back()));
    if (!text.empty() && static_cast<unsigned char>(text.back()) >= 0xc0) text.remove_suffix(1);
  }
  return std::string(text) + "…";
}

Html::Scope openSvg(Html& html, const ChartFrame& frame, double height, std::string_view label) {
  const std::string box = "0 0 " + coordinate(frame.width) + ' ' + coordinate(height);
  return html.in("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                         {"class", frame.wide ? "chart wide" : "chart narrow"},
                         {"viewBox", box},
                         {"role", "img"},
                         {"aria-label", label}});
}

void svgLine(Html& svg, std::string_view css, double x1, double y1, double x2, double y2) {
  svg.empty("line", {{"class", css},
                     {"x1", coordinate(x1)},
                     {"y1", coordinate(y1)},
                     {"x2", coordinate(x2)},
                     {"y2", coordinate(y2)}});
}

void svgRect(Html& svg, std::string_view css, double x, double y, double width, double height) {
  svg.empty("rect", {{"class", css},
                     {"x", coordinate(x)},
                     {"y", coordinate(y)},
                     {"width", coordinate(width)},
                     {"height", coordinate(height)}});
}

void svgText(Html& svg, std::string_view css, double x, double y, std::string_view text) {
  svg.element("text", {{"class", css}, {"x", coordinate(x)}, {"y", coordinate(y)}}, text);
}

void svgPath(Html& svg, std::string_view css, std::string_view d) {
  svg.empty("path", {{"class", css}, {"d", d}});
}

void drawTimeAxis(Html& svg, const ChartFrame& frame, const Axis& x, double y,
                  std::string_view title) {
  const double room = frame.wide ? 70 : 55;  // px for a label and the space to the next
  const Ticks ticks = niceTicks(x.from, x.to, static_cast<int>((x.to_px - x.from_px) / room));
  svgLine(svg, "axis", x.from_px, y, x.to_px, y);
  for (const double value : ticks.values) {
    svgLine(svg, "axis", x.at(value), y, x.at(value), y + 4);
    svgText(svg, "tick mid", x.at(value), y + 18, ticks.label(value));
  }
  svgText(svg, "label mid", (x.from_px + x.to_px) / 2, y + 37, title);
}

}  // namespace palpa::report

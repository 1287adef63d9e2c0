#include "apps/report/plot/chart_frame.h"

#include <algorithm>
#include <cmath>

#include "apps/report/page/page_parts.h"

namespace palpa::report {
namespace {

/// Steps 1, 2, 5, 10, 20, ...: number `index` counted from 10^0 (negative below one).
double stepNumber(int index) {
  const int decade = index >= 0 ? index / 3 : -((2 - index) / 3);
  static constexpr double kMantissas[] = {1, 2, 5};
  const double mantissa = kMantissas[index - 3 * decade];
  // Dividing by a power of ten is exact to the last bit where multiplying with a negative one is
  // not.
  return decade >= 0 ? mantissa * std::pow(10, decade) : mantissa / std::pow(10, -decade);
}

constexpr double kSlack = 1e-9;  // of a step: a limit that is round up to rounding counts as round

}  // namespace

std::string Ticks::label(double value) const { return fixed(value, decimals); }

Ticks niceTicks(double from, double to, int most) {
  Ticks ticks;
  most = std::max(most, 2);
  if (!std::isfinite(from) || !std::isfinite(to) || !(to > from)) return ticks;
  int index = 3 * (static_cast<int>(std::floor(std::log10((to - from) / most))) - 1);
  double first = 0, last = 0, step = 0;
  do {
    step = stepNumber(index);
    first = std::ceil(from / step - kSlack);
    last = std::floor(to / step + kSlack);
    ++index;
  } while (last - first + 1 > most);
  for (double k = first; k <= last; ++k) ticks.values.push_back(k == 0 ? 0 : k * step);
  ticks.decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + kSlack)));
  return ticks;
}

double niceCeiling(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  int index = 3 * static_cast<int>(std::floor(std::log10(value)) - 1);
  // Finer than the ticks' steps, so that a plot is not half empty: 1, 1.2, 1.5, 2, 2.5, 3, 4, 5,
  // 6, 8.
  for (;; index += 3) {
    for (const double mantissa : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
      const double candidate = mantissa * stepNumber(index);
      if (candidate >= value * (1 - kSlack)) return candidate;
    }
  }
}

std::string markPath(Tone tone, double x, double y, double r) {
  const auto at = [&](double dx, double dy) {
    return coordinate(x + dx) + ' ' + coordinate(y + dy);
  };
  if (tone == Tone::bad) {
    const double d = 1.3 * r;
    return 'M' + at(0, -d) + 'L' + at(d, 0) + 'L' + at(0, d) + 'L' + at(-d, 0) + 'Z';
  }
  if (tone == Tone::guide) {
    const double s = 0.9 * r;
    return 'M' + at(-s, -s) + 'L' + at(s, -s) + 'L' + at(s, s) + 'L' + at(-s, s) + 'Z';
  }
  const std::string arc = 'A' + coordinate(r) + ' ' + coordinate(r) + " 0 1 0 ";
  return 'M' + at(-r, 0) + arc + at(r, 0) + arc + at(-r, 0) + 'Z';
}

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

#include "apps/calibrate/page_plots.h"

#include <algorithm>

#include "apps/report/axis.h"
#include "apps/report/chart_frame.h"
#include "apps/report/numbers.h"

namespace palpa::calibrate {
namespace {

using namespace report;
constexpr double kPlotTop = 12, kPlotHeight = 150;

void drawDots(Html& svg, const Plot& plot, const Axis& x, const Axis& y) {
  for (const Plot::Dot& dot : plot.dots) {
    const double px = x.at(dot.x), py = y.at(dot.y);
    if (dot.left_out)
      svgPath(svg, "out", "M" + coordinate(px - 4) + " " + coordinate(py - 4) + "l8 8m0-8l-8 8");
    else
      svg.empty("circle", {{"class", "seen"},
                           {"cx", coordinate(px)},
                           {"cy", coordinate(py)},
                           {"r", plot.dots.size() > 100 ? "1.6" : "3"}});
  }
}

void drawFramed(Html& html, const ChartFrame& frame, const Plot& plot, double first, double last,
                double most) {
  const auto svg = openSvg(html, frame, kPlotTop + kPlotHeight + 46, plot.title);
  ChartFrame roomy = frame;
  roomy.left = 84;
  const Axis x = roomy.across(first, last), y{0, most, kPlotTop + kPlotHeight, kPlotTop};
  const Ticks ticks = niceTicks(0, most, 5);
  for (const double value : ticks.values) {
    svgLine(html, "grid", x.from_px, y.at(value), x.to_px, y.at(value));
    svgText(html, "tick end", x.from_px - 8, y.at(value) + 4, ticks.label(value) + " " + plot.y);
  }
  if (!plot.foretold.empty()) {
    std::string way;
    for (const Plot::Dot& dot : plot.foretold)
      way += (way.empty() ? "M" : " L") + coordinate(x.at(dot.x)) + " " + coordinate(y.at(dot.y));
    svgPath(html, "foretold", way);
  }
  drawDots(html, plot, x, y);
  drawTimeAxis(html, roomy, x, kPlotTop + kPlotHeight, plot.x);
}

}  // namespace

void drawPlot(Html& html, const Plot& plot) {
  if (plot.dots.empty()) return;
  double first = plot.dots.front().x > 10 ? plot.dots.front().x : 0, last = first + 1, most = 1e-9;
  bool any_out = false;
  for (const Plot::Dot& dot : plot.dots) {
    last = std::max(last, dot.x);
    most = std::max(most, dot.y);
    any_out = any_out || dot.left_out;
  }
  const auto figure = html.in("figure");
  html.element("h3", plot.title);
  for (const ChartFrame& frame : {kWide, kNarrow})
    drawFramed(html, frame, plot, first, last, niceCeiling(most));
  if (!plot.foretold.empty())
    html.element("figcaption", "Dots: measured. Line: what the result foretells.");
  if (any_out) html.element("figcaption", "Crosses: left out, because they do not fit the others.");
}

void drawCoverage(Html& html, const Coverage& coverage) {
  constexpr double kCell = 44;
  const int most = std::max(1, *std::max_element(coverage.counts.begin(), coverage.counts.end()));
  const auto figure = html.in("figure");
  html.element("h3", "Where in the picture the board was seen");
  {
    const std::string width = coordinate(kCell * coverage.columns),
                      height = coordinate(kCell * coverage.rows);
    const auto svg = html.in("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                                     {"class", "coverage"},
                                     {"viewBox", "0 0 " + width + ' ' + height},
                                     {"width", width},
                                     {"role", "img"},
                                     {"aria-label", "Corners seen in each part of the picture"}});
    for (int i = 0; i < coverage.columns * coverage.rows; ++i) {
      const int count = coverage.counts[static_cast<std::size_t>(i)];
      const double px = kCell * (i % coverage.columns), py = kCell * (i / coverage.columns);
      const std::string shade = trimmed(0.12 + 0.6 * count / most, 2);
      html.empty("rect", {{"class", count ? "cell" : "cell none"},
                          {"x", coordinate(px + 1.5)},
                          {"y", coordinate(py + 1.5)},
                          {"width", coordinate(kCell - 3)},
                          {"height", coordinate(kCell - 3)},
                          {"fill-opacity", shade}});
      svgText(html, "tick mid", px + kCell / 2, py + kCell / 2 + 4, std::to_string(count));
    }
  }
  html.element("figcaption",
               "Corners counted in each part. Empty parts (dashed) leave the lens unknown there.");
}

std::string plotStyle() {
  return ".seen{fill:var(--blue)}.foretold{stroke:var(--ink,currentColor);stroke-width:1.5;fill:"
         "none}.out{stroke:var(--bad);stroke-width:2;fill:none}.end{text-anchor:end}"
         ".cell{fill:var(--blue)}.cell.none{fill:none;stroke:var(--muted);stroke-dasharray:3 "
         "3}.coverage{max-width:100%;height:auto}"
         "header .verdict{margin-top:1.1rem}\n";
}

}  // namespace palpa::calibrate

#include "apps/calibrate/page.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/whole_file.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/page/style.h"
#include "apps/report/plot/chart_frame.h"

namespace palpa::calibrate {
namespace {

using namespace report;
constexpr double kPlotTop = 12, kPlotHeight = 150;

void drawDots(Html& svg, const MeasuredPlot& plot, const Axis& x, const Axis& y) {
  for (const MeasuredPlot::Dot& dot : plot.dots) {
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

void drawFramed(Html& html, const ChartFrame& frame, const MeasuredPlot& plot, double first,
                double last, double most) {
  const auto svg = openSvg(html, frame, kPlotTop + kPlotHeight + 46, plot.title);
  ChartFrame roomy = frame;
  roomy.left = 84;
  const Axis x = roomy.across(first, last), y{0, most, kPlotTop + kPlotHeight, kPlotTop};
  const Ticks ticks = niceTicks(0, most, 5);
  for (const double value : ticks.values) {
    svgLine(html, "grid", x.from_px, y.at(value), x.to_px, y.at(value));
    svgText(html, "tick end", x.from_px - 8, y.at(value) + 4, ticks.label(value) + " " + plot.y);
  }
  if (!plot.predicted.empty()) {
    std::string way;
    for (const MeasuredPlot::Dot& dot : plot.predicted)
      way += (way.empty() ? "M" : " L") + coordinate(x.at(dot.x)) + " " + coordinate(y.at(dot.y));
    svgPath(html, "predicted", way);
  }
  drawDots(html, plot, x, y);
  const double bottom = kPlotTop + kPlotHeight;
  if (plot.marks.empty()) return drawTimeAxis(html, roomy, x, bottom, plot.x);
  svgLine(html, "axis", x.from_px, bottom, x.to_px, bottom);
  for (const auto& [at, words] : plot.marks) {
    svgLine(html, "axis", x.at(at), bottom, x.at(at), bottom + 4);
    svgText(html, "tick mid", x.at(at), bottom + 18, words);
  }
  svgText(html, "label mid", (x.from_px + x.to_px) / 2, bottom + 37, plot.x);
}

}  // namespace

void drawPlot(Html& html, const MeasuredPlot& plot) {
  if (plot.dots.empty()) return;
  double first = plot.dots.front().x > 10 ? plot.dots.front().x : 0, last = first + 1, most = 1e-9;
  bool any_out = false;
  for (const MeasuredPlot::Dot& dot : plot.dots) {
    last = std::max(last, dot.x);
    most = std::max(most, dot.y);
    any_out = any_out || dot.left_out;
  }
  const auto figure = html.in("figure");
  html.element("h3", plot.title);
  for (const ChartFrame& frame : {kWide, kNarrow})
    drawFramed(html, frame, plot, first, last, niceCeiling(most));
  if (!plot.predicted.empty())
    html.element("figcaption", "Dots: measured. Line: what the result predicts.");
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

void drawMap(Html& html, const DrawnMap& map) {
  constexpr double kSide = 440, kDot = 2.5;  // px
  const auto [least, most] = std::minmax_element(map.values.begin(), map.values.end());
  const double cell_x = kSide / map.columns, cell_y = kSide / map.rows;
  const std::string side = coordinate(kSide);
  const auto figure = html.in("figure");
  html.element("h3", map.title);
  {
    const auto svg = html.in("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                                     {"class", "coverage"},
                                     {"viewBox", "0 0 " + side + ' ' + side},
                                     {"width", side},
                                     {"role", "img"},
                                     {"aria-label", map.title + " all over the top"}});
    for (std::size_t i = 0; i < map.values.size(); ++i) {
      const auto column = static_cast<int>(i) % map.columns,
                 row = map.rows - 1 - static_cast<int>(i) / map.columns;
      const double share = (map.values[i] - *least) / std::max(*most - *least, 1e-12);
      html.empty("rect", {{"class", map.unsure[i] ? "cell unsure" : "cell"},
                          {"x", coordinate(cell_x * column)},
                          {"y", coordinate(cell_y * row)},
                          {"width", coordinate(cell_x)},
                          {"height", coordinate(cell_y)},
                          {"fill-opacity", trimmed(0.08 + 0.92 * share, 2)}});
    }
    const Eigen::Vector2d size = map.high - map.low;
    for (const Eigen::Vector2d& touch : map.touches)
      html.empty("circle", {{"class", "touched"},
                            {"cx", coordinate(kSide * (touch.x() - map.low.x()) / size.x())},
                            {"cy", coordinate(kSide * (map.high.y() - touch.y()) / size.y())},
                            {"r", coordinate(kDot)}});
  }
  html.element("figcaption", "From " + quantity(*least, map.unit) + " (light) to " +
                                 quantity(*most, map.unit) +
                                 " (dark), seen from above; dots: touched. In dashed cells it is "
                                 "not known within 10 %.");
}

std::string plotStyle() {
  return ".seen{fill:var(--blue)}.predicted{stroke:var(--ink,currentColor);stroke-width:1.5;fill:"
         "none}.out{stroke:var(--bad);stroke-width:2;fill:none}.end{text-anchor:end}"
         ".cell{fill:var(--blue)}.cell.none{fill:none;stroke:var(--muted);stroke-dasharray:3 "
         "3}.coverage{max-width:100%;height:auto}"
         ".cell.unsure{stroke:var(--muted);stroke-dasharray:2 3}"
         ".touched{fill:var(--card,#fff);stroke:var(--ink,currentColor)}"
         "header .verdict{margin-top:1.1rem}\n";
}

namespace {

using report::Html;

void writeFrameHead(Html& html, const PageFrame& frame) {
  const auto head = html.in("head");
  html.empty("meta", {{"charset", "utf-8"}});
  html.empty("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
  html.empty("meta", {{"name", "color-scheme"}, {"content", "light dark"}});
  html.element("title", frame.window);
  const auto style = html.in("style");
  html.raw(report::styleSheet());
  html.raw(plotStyle());
  html.raw(frame.style);
}

void writeFrameTop(Html& html, const PageFrame& frame) {
  html.element("h1", frame.heading);
  {
    const auto who = html.in("p", {{"class", "who"}});
    for (const auto& [name, value] : frame.who) {
      const auto span = html.in("span");
      html.text(name + ' ');
      html.element("strong", value);
    }
  }
  if (frame.simulated.empty()) return;
  const auto banner = html.in("p", {{"class", "banner"}, {"role", "note"}});
  html.element("strong", "SIMULATED");
  html.text(frame.simulated);
}

}  // namespace

void writeFramed(const PageFrame& frame, const std::function<void(Html&)>& top,
                 const std::function<void(Html&)>& main, const std::filesystem::path& file) {
  Html html;
  html.raw("<!DOCTYPE html>\n");
  {
    const auto page = html.in("html", {{"lang", "en"}});
    writeFrameHead(html, frame);
    const auto body = html.in("body");
    {
      const auto header = html.in("header");
      writeFrameTop(html, frame);
      top(html);
    }
    const auto in_main = html.in("main");
    main(html);
  }
  writeWhole(file, html.page() + "\n");
}

void writeFact(Html& html, const std::string& name, const std::string& value,
               const std::string& note) {
  const auto row = html.in("tr");
  html.element("th", {{"scope", "row"}}, name);
  html.element("td", {{"class", "value"}}, value);
  html.element("td", {{"class", "muted"}}, note);
}

namespace {

using report::Html;

void writeVerdict(Html& html, const std::vector<Result>& results) {
  const bool good =
      std::all_of(results.begin(), results.end(), [](const Result& r) { return r.file.passed(); });
  const auto verdict = html.in("div", {{"class", good ? "verdict good" : "verdict bad"}});
  const auto finding = html.in("div", {{"class", "finding"}});
  html.element("p", {{"class", "outcome"}},
               good ? "✓ Ready: sessions on this station are scored"
                    : "✗ Not ready: sessions on this station are not scored");
  for (const Result& r : results)
    html.element("p", (r.file.passed() ? "✓ " : "✗ ") + r.title +
                          (r.file.passed() ? "" : ": " + r.file.verdict));
}

void writeChecks(Html& html, const Result& r) {
  if (r.file.checks.empty()) return;
  const auto table = html.in("table", {{"class", "facts"}});
  const auto body = html.in("tbody");
  for (const auto& check : r.file.checks)
    writeFact(html, (check.passed() ? "✓ " : "✗ ") + check.name, quantity(check.value, check.unit),
              "good up to " + quantity(check.limit, check.unit));
}

/// "recorded files: pivot.csv, spin.csv"
std::string sourceOf(const station::CalibrationFile::Data& data) {
  constexpr std::size_t kNamed = 3;
  std::string words = data.source;
  for (std::size_t i = 0; i < std::min(kNamed, data.files.size()); ++i)
    words += (i ? ", " : ": ") + data.files[i].name;
  return data.files.size() > kNamed
             ? words + " and " + std::to_string(data.files.size() - kNamed) + " more"
             : words;
}

void writeResult(Html& html, const Result& r) {
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", r.title);
  for (const std::string& sentence : r.sentences) html.element("p", sentence);
  writeChecks(html, r);
  for (const std::string& advice : r.advice) html.element("p", {{"class", "muted"}}, advice);
  html.element("p", {{"class", "muted small"}},
               "Good for " + std::to_string(r.file.valid_days) + " days. " +
                   std::to_string(r.file.data.used) + " of " + std::to_string(r.file.data.samples) +
                   " samples used, from: " + sourceOf(r.file.data) + ".");
  if (!r.coverage.counts.empty()) drawCoverage(html, r.coverage);
  for (const DrawnMap& map : r.maps) drawMap(html, map);
  for (const MeasuredPlot& plot : r.plots) drawPlot(html, plot);
}

}  // namespace

void writePage(const PageHead& head, const std::vector<Result>& results,
               const std::filesystem::path& file) {
  PageFrame frame{"Calibration · " + head.station,
                  "Calibration of the station",
                  {{"Station", head.station}, {"Date", head.date}},
                  "",
                  ""};
  if (head.seconds > 0) frame.who.emplace_back("Took", quantity(head.seconds, "s"));
  if (head.simulated)
    frame.simulated =
        "Made on the virtual bench by a simulated hand: it says nothing about a real station.";
  const auto main = [&](Html& html) {
    for (const Result& r : results) writeResult(html, r);
    if (head.remarks.empty()) return;
    const auto section = html.in("section", {{"class", "card"}});
    html.element("h2", "Against the simulated truth");
    for (const std::string& remark : head.remarks) html.element("p", remark);
  };
  writeFramed(
      frame, [&](Html& html) { writeVerdict(html, results); }, main, file);
}

}  // namespace palpa::calibrate

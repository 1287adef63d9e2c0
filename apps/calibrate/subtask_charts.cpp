#include "apps/calibrate/subtask_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "apps/report/page/page_parts.h"
#include "apps/report/page/style.h"
#include "apps/report/plot/chart_frame.h"

namespace palpa::calibrate {
namespace {

using namespace report;

constexpr double kCurveTop = 14, kCurveHeight = 170, kRepeatHeight = 70, kCurveGap = 34;  // px
constexpr double kLanePitch = 17, kLaneBar = 13, kGroupGap = 10, kNameRow = 16;           // px
constexpr double kStripStep_s = 1e-9 * static_cast<double>(kSubtaskStep_ns);

/// In an order in which neighbours differ in lightness as well.
constexpr std::array<std::string_view, 8> kStateColours{
    palette::kBlue,       palette::kOrange,  palette::kGreen,  palette::kPurple,
    palette::kVermillion, palette::kSkyBlue, palette::kYellow, palette::kBlack};

void drawDot(Html& svg, const char* css, double x, double y, double radius) {
  svg.empty(
      "circle",
      {{"class", css}, {"cx", coordinate(x)}, {"cy", coordinate(y)}, {"r", coordinate(radius)}});
}

void drawGrid(Html& svg, const Axis& x, const Axis& y, int most) {
  const Ticks ticks = niceTicks(std::min(y.from, y.to), std::max(y.from, y.to), most);
  for (const double value : ticks.values) {
    svgLine(svg, "grid", x.from_px, y.at(value), x.to_px, y.at(value));
    svgText(svg, "tick end", x.from_px - 8, y.at(value) + 4, ticks.label(value));
  }
}

/// A line through one figure for each number of states, with its error where there is one.
void drawFigures(Html& svg, const SubtaskSegmentation& found, const Axis& x, const Axis& y,
                 const std::function<double(const calibration::HeldOut&)>& figure, bool errors) {
  std::string way;
  for (const calibration::HeldOut& one : found.proposal.curve) {
    const double px = x.at(one.states), py = y.at(figure(one));
    way += (way.empty() ? "M" : " L") + coordinate(px) + " " + coordinate(py);
    if (errors)
      svgLine(svg, "spread", px, y.at(one.mean - one.standard_error), px,
              y.at(one.mean + one.standard_error));
  }
  svgPath(svg, "through", way);
  for (const calibration::HeldOut& one : found.proposal.curve) {
    drawDot(svg, "seen", x.at(one.states), y.at(figure(one)), 3.5);
    if (one.states == found.states) drawDot(svg, "taken", x.at(one.states), y.at(figure(one)), 8);
  }
}

void drawCurveFramed(Html& html, const SubtaskSegmentation& found, const ChartFrame& given) {
  const auto& curve = found.proposal.curve;
  double low = curve.front().mean, high = low;
  for (const calibration::HeldOut& one : curve) {
    low = std::min(low, one.mean - one.standard_error);
    high = std::max(high, one.mean + one.standard_error);
  }
  ChartFrame frame = given;
  frame.left = frame.wide ? 64 : 42;
  const double room = std::max(0.05 * (high - low), 1e-6),
               repeat_top = kCurveTop + kCurveHeight + kCurveGap,
               bottom = repeat_top + kRepeatHeight;
  const Axis x = frame.across(0.5, static_cast<double>(curve.size()) + 0.5),
             y{low - room, high + room, kCurveTop + kCurveHeight, kCurveTop},
             z{0, 1, bottom, repeat_top};
  const auto svg = openSvg(html, frame, bottom + 46,
                           "Held-out log likelihood and repeatability over the number of states");
  drawGrid(html, x, y, 5);
  drawFigures(
      html, found, x, y, [](const calibration::HeldOut& one) { return one.mean; }, true);
  svgText(html, "legend", x.from_px, repeat_top - 10,
          "two halves of the trials: adjusted Rand index");
  drawGrid(html, x, z, 3);
  drawFigures(
      html, found, x, z,
      [](const calibration::HeldOut& one) { return std::max(0.0, one.repeated); }, false);
  for (const calibration::HeldOut& one : curve)
    svgText(html, "tick mid", x.at(one.states), bottom + 18, std::to_string(one.states));
  svgText(html, "tick mid", (x.from_px + x.to_px) / 2, bottom + 38, "number of states");
}

/// Stretches of steps in which something holds, as bars.
void drawBars(Html& svg, const Axis& x, double top, std::size_t steps, const std::string& style,
              const char* css, const std::function<bool(std::size_t)>& on) {
  std::string way;
  for (std::size_t i = 0; i < steps; ++i) {
    if (!on(i)) continue;
    const std::size_t begin = i;
    while (i + 1 < steps && on(i + 1)) ++i;
    const double from = x.at(kStripStep_s * static_cast<double>(begin)),
                 to = x.at(kStripStep_s * static_cast<double>(i + 1));
    way += "M" + coordinate(from) + " " + coordinate(top) + "H" +
           coordinate(std::max(to, from + 0.4)) + "V" + coordinate(top + kLaneBar) + "H" +
           coordinate(from) + "Z";
  }
  if (way.empty()) return;
  if (style.empty())
    svg.empty("path", {{"class", css}, {"d", way}});
  else
    svg.empty("path", {{"class", css}, {"style", style}, {"d", way}});
}

void drawLaneName(Html& svg, const ChartFrame& frame, double top, const std::string& name) {
  svgText(svg, "tick", 0, top + kLaneBar - 2, fitted(name, frame.left - 6, frame.font));
}

void drawStripFramed(Html& html, const SubtaskRecordings& recordings,
                     const SubtaskSegmentation& found, std::size_t sequence,
                     const ChartFrame& given) {
  const SubtaskSequence& trial = recordings.sequences[sequence];
  const std::vector<int>& path = found.paths[sequence];
  ChartFrame frame = given;
  frame.left = frame.wide ? 140 : 84;
  const double lanes = static_cast<double>(recordings.parts.size() + found.steps.one.size());
  const double bottom = 2 * kNameRow + kGroupGap + lanes * kLanePitch;
  const Axis x = frame.across(0, kStripStep_s * static_cast<double>(path.size()));
  const auto svg = openSvg(html, frame, bottom + 42,
                           trial.trial + ": hand-written parts above, proposed states below");
  double top = kNameRow;
  const auto lane = [&](const std::string& name, const std::string& style, const char* css,
                        const std::function<bool(std::size_t)>& on) {
    drawLaneName(html, frame, top, name);
    svgRect(html, "lane", x.from_px, top, x.to_px - x.from_px, kLaneBar);
    drawBars(html, x, top, path.size(), style, css, on);
    top += kLanePitch;
  };
  svgText(html, "tick strong", 0, top - 4, "hand-written");
  for (std::size_t part = 0; part < recordings.parts.size(); ++part)
    lane(recordings.parts[part].name, "", "written",
         [&](std::size_t i) { return (trial.labels[i] >> part & 1) != 0; });
  top += kGroupGap + kNameRow;
  svgText(html, "tick strong", 0, top - 4, "proposed");
  for (const int state : found.steps.one)
    lane("state " + std::to_string(state + 1),
         "fill:" +
             std::string(kStateColours[static_cast<std::size_t>(state) % kStateColours.size()]),
         state == 7 ? "proposed dark" : "proposed",
         [&](std::size_t i) { return path[i] == state; });
  drawTimeAxis(html, frame, x, bottom, "time of the trial, s");
}

}  // namespace

void drawStatesCurve(Html& html, const SubtaskSegmentation& found) {
  const auto figure = html.in("figure");
  html.element("h3", "How many states?");
  for (const ChartFrame& frame : {kWide, kNarrow}) drawCurveFramed(html, found, frame);
  html.element(
      "figcaption",
      "Above: log likelihood of trials that were held out, nats for each step; bars are standard "
      "errors over trials. Higher predicts better. Below: whether two halves of the trials "
      "find the same segmentation (1: the same). Ringed: the number taken.");
}

void drawTrialStrip(Html& html, const SubtaskRecordings& recordings,
                    const SubtaskSegmentation& found, std::size_t sequence) {
  const auto figure = html.in("figure");
  html.element("h3", recordings.sequences[sequence].trial);
  for (const ChartFrame& frame : {kWide, kNarrow})
    drawStripFramed(html, recordings, found, sequence, frame);
}

std::string subtaskChartStyle() {
  return "svg .spread{stroke:var(--ink);stroke-width:1.5}svg "
         ".through{fill:none;stroke:var(--blue);stroke-width:1.5}svg "
         ".taken{fill:none;stroke:var(--ink);stroke-width:2}"
         "svg .written{fill:var(--plain)}svg .proposed{stroke:none}svg "
         ".dark{fill:var(--ink)!important}"
         ".states td.name,.states th.name{text-align:left;white-space:normal}.states "
         "td.mine{font-weight:650;outline:1.5px solid var(--blue);outline-offset:-2px}\n";
}

}  // namespace palpa::calibrate

#include "apps/report/needle/trial_chart.h"

#include <algorithm>
#include <cmath>

#include "apps/report/page/page_parts.h"
#include "apps/report/page/style.h"
#include "apps/report/plot/svg_plot.h"

namespace palpa::report {
namespace {

constexpr int kMostMarkRows = 7;
constexpr double kBetween = 28;  // px between the bands

PlotCurve curveOf(const std::vector<assess::TrialSample>& samples, const char* label,
                  const char* css, double (*value)(const assess::TrialSample&)) {
  PlotCurve curve{label, css, {}, false};
  curve.points.reserve(samples.size());
  for (const auto& sample : samples) curve.points.push_back({sample.t_s, value(sample)});
  return curve;
}

double largest(const std::vector<PlotCurve>& curves) {
  double high = 0;
  for (const PlotCurve& curve : curves) {
    for (const ChartPoint& p : curve.points) {
      if (std::isfinite(p.y)) high = std::max(high, p.y);
    }
  }
  return high;
}

double forceOf(const assess::TrialSample& s) { return s.f_contact; }
double depthOf(const assess::TrialSample& s) {
  return std::isfinite(s.depth) ? std::max(0.0, 1000 * s.depth) : s.depth;
}

/// The other trial's line comes last, so that it lies on top.
void addBeside(const BesideTrial& beside, double (*value)(const assess::TrialSample&),
               PlotPanel* panel) {
  if (!beside.samples.empty())
    panel->curves.push_back(curveOf(beside.samples, beside.label.c_str(), "beside", value));
}

PlotPanel forcePanel(const TrialPage& page, bool wide) {
  const std::vector<assess::TrialSample>& samples = page.samples;
  PlotPanel panel{"Force", "N", {}, 1, 0, wide ? 150.0 : 130.0};
  panel.curves.push_back(curveOf(samples, "computed", "computed", forceOf));
  panel.curves.push_back(curveOf(samples, "rendered", "rendered",
                                 [](const assess::TrialSample& s) { return s.f_command; }));
  addBeside(page.beside, forceOf, &panel);
  panel.y_top = niceCeiling(std::max(largest(panel.curves), 0.1));  // a flat line stays flat
  return panel;
}

PlotPanel depthPanel(const TrialPage& page, bool wide) {
  PlotPanel panel{wide ? "Depth" : "Depth of the tip", "mm", {}, 0, 1, wide ? 120.0 : 110.0};
  panel.curves.push_back(curveOf(page.samples, page.beside.samples.empty() ? "depth" : "this trial",
                                 "depth", depthOf));
  panel.curves.back().filled = true;
  addBeside(page.beside, depthOf, &panel);
  panel.y_bottom = niceCeiling(std::max(largest(panel.curves), 1.0));  // deeper is lower
  return panel;
}

struct Bands {
  std::vector<Lane> lanes;
  std::vector<assess::Moment> moments;
  std::vector<PlacedMark> marks;
  std::vector<PlotPanel> panels;
  double marks_height = 0, lanes_height = 0, height = 0;
};

Bands bandsOf(const TrialPage& page, const ChartFrame& frame, const Axis& x) {
  Bands bands;
  bands.lanes = lanesOf(page.assessment.spans);
  bands.moments = orderedMoments(page.assessment);
  bands.marks = placeMarks(bands.moments, x, frame, kMostMarkRows);
  for (const auto& mark : bands.marks) {
    bands.marks_height = std::max(bands.marks_height, (mark.row + 1) * kMarkRow + 6);
  }
  bands.lanes_height = laneHeight(frame) * static_cast<double>(bands.lanes.size());
  if (!page.samples.empty()) {
    bands.panels = {forcePanel(page, frame.wide), depthPanel(page, frame.wide)};
  }
  bands.height = bands.marks_height + bands.lanes_height + 44;
  for (const auto& panel : bands.panels) {
    bands.height += kBetween + headingHeight(frame) + panel.height;
  }
  return bands;
}

void drawPanels(Html& svg, const ChartFrame& frame, const Axis& x, const Bands& bands) {
  double top = bands.marks_height;
  for (const Lane& lane : bands.lanes) {
    drawLane(svg, frame, x, top, lane);
    top += laneHeight(frame);
  }
  for (const PlotPanel& panel : bands.panels) {
    top += kBetween + headingHeight(frame);
    drawPanel(svg, frame, x, top, panel);
    if (frame.wide && panel.title != "Force" && panel.curves.size() == 1)
      svgText(svg, "legend", 0, top + 31, "of the tip");
    top += panel.height;
  }
  drawTimeAxis(svg, frame, x, top + 2, "time since the start of the trial, s");
}

void drawChart(Html& html, const TrialPage& page, const ChartFrame& frame) {
  const Axis x = frame.across(0, durationOf(page));
  const Bands bands = bandsOf(page, frame, x);
  const auto svg = openSvg(html, frame, bands.height,
                           "Course of trial " + std::to_string(page.assessment.trial) +
                               ": phases, contacts and marked moments, force in newtons and depth "
                               "in millimetres over " +
                               trimmed(x.to, 1) + " seconds");
  const auto middle = [&](const PlacedMark& mark) {
    return bands.marks_height - 6 - (mark.row + 0.5) * kMarkRow;
  };
  for (std::size_t i = 0; i < bands.marks.size(); ++i) {
    drawMarkLine(html, bands.marks[i], bands.moments[i], middle(bands.marks[i]), bands.height - 42);
  }
  drawPanels(html, frame, x, bands);
  for (std::size_t i = 0; i < bands.marks.size(); ++i) {
    drawMark(html, bands.marks[i], bands.moments[i], static_cast<int>(i) + 1,
             middle(bands.marks[i]));
  }
}

void writeMomentList(Html& html, const TrialPage& page) {
  const auto moments = orderedMoments(page.assessment);
  if (moments.empty()) return;
  const auto marks = placeMarks(moments, kWide.across(0, durationOf(page)), kWide, kMostMarkRows);
  // Beside the wide chart the list would repeat its words, if they found room there.
  const auto list = html.in("ol", {{"class", marks.front().words ? "moments narrow" : "moments"}});
  for (const auto& moment : moments) {
    const auto item = html.in("li", {{"class", cssClass(toneOfMoment(moment.kind))}});
    html.element("span", {{"class", "time"}}, fixed(moment.t_s, 1) + " s");
    html.text(moment.text);
  }
}

}  // namespace

double durationOf(const TrialPage& page) {
  double end = page.assessment.values.time_ms / 1000;
  if (!std::isfinite(end)) end = 0;
  const auto reach = [&](double t) {
    if (std::isfinite(t)) end = std::max(end, t);
  };
  for (const auto& sample : page.samples) reach(sample.t_s);
  for (const auto& sample : page.beside.samples) reach(sample.t_s);
  for (const auto& span : page.assessment.spans) reach(span.to_s);
  for (const auto& moment : page.assessment.moments) reach(moment.t_s);
  return end > 0 ? end : 1;
}

std::vector<assess::Moment> orderedMoments(const assess::TrialAssessment& assessment) {
  std::vector<assess::Moment> moments;
  for (const auto& moment : assessment.moments) {
    if (std::isfinite(moment.t_s)) moments.push_back(moment);
  }
  std::stable_sort(moments.begin(), moments.end(),
                   [](const auto& a, const auto& b) { return a.t_s < b.t_s; });
  return moments;
}

void writeTrialChart(Html& html, const TrialPage& page) {
  const auto figure = html.in("figure", {{"class", "course"}});
  drawChart(html, page, kWide);
  drawChart(html, page, kNarrow);
  writeMomentList(html, page);
  if (page.samples.empty()) html.element("figcaption", "No motion was recorded in this trial.");
  if (!page.beside.samples.empty()) html.element("figcaption", page.beside.words);
}

}  // namespace palpa::report

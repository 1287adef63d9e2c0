#include "apps/report/needle/trial_chart.h"

#include <algorithm>
#include <cmath>

#include "apps/report/page/style.h"
#include "apps/report/plot/chart_frame.h"

namespace palpa::report {
namespace {

constexpr double kRadius = 9;  // of a numbered mark
constexpr double kGap = 5;     // between a mark and its words
constexpr double kApart = 8;   // between neighbours in a row

Tone toneOfSpan(assess::SpanKind kind) {
  return kind == assess::SpanKind::good    ? Tone::good
         : kind == assess::SpanKind::guide ? Tone::guide
         : kind == assess::SpanKind::bad   ? Tone::bad
                                           : Tone::neutral;
}

bool overlap(const PlacedMark& a, const PlacedMark& b) {
  return a.from_px < b.to_px + kApart && b.from_px < a.to_px + kApart;
}

PlacedMark unplaced(const assess::Moment& moment, const Axis& x, const ChartFrame& frame,
                    bool words) {
  PlacedMark mark;
  mark.x = x.at(std::clamp(moment.t_s, x.from, x.to));
  mark.words = words;
  mark.from_px = mark.x - kRadius;
  mark.to_px = mark.x + kRadius;
  if (!words) return mark;
  const double width = kGap + textWidth(moment.text, frame.font),
               longest = kLongerElsewhere * width;
  mark.leftward = mark.to_px + longest > frame.width && mark.from_px - longest > 0;
  mark.words = mark.leftward || mark.to_px + longest <= frame.width;
  if (!mark.words) return mark;
  (mark.leftward ? mark.from_px : mark.to_px) += mark.leftward ? -width : width;
  return mark;
}

/// Later marks are placed already. Words must lie above the rows of all later marks within their
/// reach, for the lines of those run downward.
int lowestRow(const PlacedMark& mark, const std::vector<PlacedMark>& marks, std::size_t later) {
  int row = 0;
  for (std::size_t i = later; i < marks.size(); ++i) {
    if (overlap(mark, marks[i])) row = std::max(row, marks[i].row + 1);
  }
  return row;
}

std::vector<PlacedMark> place(const std::vector<assess::Moment>& moments, const Axis& x,
                              const ChartFrame& frame, bool words) {
  std::vector<PlacedMark> marks(moments.size());
  for (std::size_t i = moments.size(); i-- > 0;) {
    marks[i] = unplaced(moments[i], x, frame, words);
    marks[i].row = lowestRow(marks[i], marks, i + 1);
  }
  return marks;
}

int rowCount(const std::vector<PlacedMark>& marks) {
  int rows = 0;
  for (const PlacedMark& mark : marks) rows = std::max(rows, mark.row + 1);
  return rows;
}

}  // namespace

std::vector<Lane> lanesOf(const std::vector<assess::Span>& spans) {
  std::vector<Lane> lanes;
  for (const assess::Span& span : spans) {
    const std::string label = span.kind == assess::SpanKind::phase ? "phases" : span.label;
    const auto lane = std::find_if(lanes.begin(), lanes.end(), [&](const Lane& l) {
      return l.label == label && l.spans.front().kind == span.kind;
    });
    if (lane == lanes.end()) {
      lanes.push_back({label, {span}});
    } else {
      lane->spans.push_back(span);
    }
  }
  std::stable_sort(lanes.begin(), lanes.end(), [](const Lane& a, const Lane& b) {
    return a.spans.front().kind < b.spans.front().kind;
  });
  return lanes;
}

double laneHeight(const ChartFrame& frame) { return frame.wide ? 26 : 36; }

void drawLane(Html& svg, const ChartFrame& frame, const Axis& x, double top, const Lane& lane) {
  const double bar = 18, y = top + laneHeight(frame) - bar - 2;
  if (frame.wide) {
    svgText(svg, "label", 0, y + 13.5, fitted(lane.label, frame.left - 8, frame.font));
  } else {
    svgText(svg, "label", 0, y - 5, fitted(lane.label, frame.width, frame.font));
  }
  {
    const auto group = svg.in("g");
    svg.element("title", lane.label);  // whole, where the name above had to be cut
    svgRect(svg, "lane", x.from_px, y, x.to_px - x.from_px, bar);
  }
  for (const assess::Span& span : lane.spans) {
    const double from = x.at(std::clamp(span.from_s, x.from, x.to));
    const double width = std::max(2.0, x.at(std::clamp(span.to_s, x.from, x.to)) - from);
    svgRect(svg, std::string("span ") + cssClass(toneOfSpan(span.kind)), from, y, width, bar);
    const bool named = lane.label != span.label &&
                       width > kLongerElsewhere * textWidth(span.label, frame.font) + 10;
    if (named) svgText(svg, "inside", from + 6, y + 13.5, span.label);
  }
}

std::vector<PlacedMark> placeMarks(const std::vector<assess::Moment>& moments, const Axis& x,
                                   const ChartFrame& frame, int most_rows) {
  if (frame.wide) {
    std::vector<PlacedMark> marks = place(moments, x, frame, true);
    if (rowCount(marks) <= most_rows) return marks;
  }
  return place(moments, x, frame, false);
}

void drawMarkLine(Html& svg, const PlacedMark& mark, const assess::Moment& moment, double y,
                  double bottom) {
  svgLine(svg, std::string("moment ") + cssClass(toneOfMoment(moment.kind)), mark.x, y, mark.x,
          bottom);
}

void drawMark(Html& svg, const PlacedMark& mark, const assess::Moment& moment, int number,
              double y) {
  const Tone tone = toneOfMoment(moment.kind);
  svgPath(svg, std::string("mark ") + cssClass(tone), markPath(tone, mark.x, y, kRadius));
  svgText(svg, std::string("number mid ") + cssClass(tone), mark.x, y + 3.8,
          std::to_string(number));
  if (!mark.words) return;
  const double x = mark.leftward ? mark.x - kRadius - kGap : mark.x + kRadius + kGap;
  svgText(svg, mark.leftward ? "words end" : "words", x, y + 4.5, moment.text);
}

}  // namespace palpa::report

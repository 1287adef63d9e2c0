#pragma once

#include <string>
#include <vector>

#include "apps/assess/needle/trial_assessment.h"
#include "apps/report/needle/session_report.h"
#include "apps/report/page/html.h"
#include "apps/report/plot/chart_frame.h"

namespace palpa::report {

/// One row of the timeline: phases share one, every other label has its own.
struct Lane {
  std::string label;
  std::vector<assess::Span> spans;
};

/// Phases first, then what guides, what is good, what is bad; within these as they came.
std::vector<Lane> lanesOf(const std::vector<assess::Span>& spans);

double laneHeight(const ChartFrame& frame);
void drawLane(Html& svg, const ChartFrame& frame, const Axis& x, double top, const Lane& lane);

/// Where the numbered mark of a moment and its words stand above the lanes.
struct PlacedMark {
  double x = 0;
  int row = 0;                    ///< 0: lowest, nearest to the lanes
  bool words = false;             ///< false: the number alone, the words stand in the list below
  bool leftward = false;          ///< words end at the mark
  double from_px = 0, to_px = 0;  ///< what it occupies in its row
};

/// No two of a row touch. A mark keeps its exact moment; its words go right of it (left near the
/// edge), in the lowest row where no line of a later moment would run through them. When words
/// would need more than `most_rows`, numbers alone are placed. `moments` in order of time.
std::vector<PlacedMark> placeMarks(const std::vector<assess::Moment>& moments, const Axis& x,
                                   const ChartFrame& frame, int most_rows);

inline constexpr double kMarkRow = 22;  ///< px

/// Line from the mark's row at `y` down to `bottom`, the numbered mark, its words.
void drawMarkLine(Html& svg, const PlacedMark& mark, const assess::Moment& moment, double y,
                  double bottom);
void drawMark(Html& svg, const PlacedMark& mark, const assess::Moment& moment, int number,
              double y);

/// The course of a trial over one time axis: numbered moments, lanes, force, depth. The moments run
/// as thin lines through all of it. Drawn wide and narrow.
void writeTrialChart(Html& html, const TrialPage& page);

/// End of the time axis, s: the last thing that happened.
double durationOf(const TrialPage& page);

/// The moments in order of time: the numbers in chart and list.
std::vector<assess::Moment> orderedMoments(const assess::TrialAssessment& assessment);

}  // namespace palpa::report

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/report/html.h"

namespace palpa::report {

/// A row of a dot plot: its name, its values as hollow dots, their mean with an interval, words at
/// the right.
struct PlotRow {
  std::string name;
  std::vector<double> values;
  double mean = 0;
  std::optional<std::pair<double, double>> interval;
  std::string words;
};

/// Rows over one axis, drawn wide and narrow.
struct RowPlot {
  std::string label;  ///< what a person who cannot see it is told
  std::string axis;   ///< "time, s"
  double from = 0, to = 1;
  std::optional<double> middle;  ///< a line through all rows: the group's mean
  std::vector<PlotRow> rows;
};
void drawRowPlot(Html& html, const RowPlot& plot);

}  // namespace palpa::report

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/calibrate/result.h"
#include "apps/report/page/html.h"

namespace palpa::calibrate {

/// Dots over what they were measured at; those left out are crosses, so that more than their colour
/// differs.
void drawPlot(report::Html& html, const MeasuredPlot& plot);

/// The picture in cells, darker where more corners were seen; an empty cell is framed in dashes.
void drawCoverage(report::Html& html, const Coverage& coverage);

void drawMap(report::Html& html, const DrawnMap& map);

/// Added to the page's style sheet.
std::string plotStyle();

/// What the pages of this folder have in common: head, style, title, who and when, the word
/// SIMULATED.
struct PageFrame {
  std::string window, heading;                           ///< title of the window, of the page
  std::vector<std::pair<std::string, std::string>> who;  ///< "Station", its name
  std::string simulated;                                 ///< what that means here; empty: it is not
  std::string style;                                     ///< besides the pages' common one
};

/// `top`: the header's rest; `main`: the page. Written whole. Throws Error.
void writeFramed(const PageFrame& frame, const std::function<void(report::Html&)>& top,
                 const std::function<void(report::Html&)>& main, const std::filesystem::path& file);

/// A row of a table of facts: what, how much, and what to think of it.
void writeFact(report::Html& html, const std::string& name, const std::string& value,
               const std::string& note);

/// What the page says on top.
struct PageHead {
  std::string station, date;
  bool simulated = false;
  double seconds = 0;                ///< how long the set-up took; 0: not said
  std::vector<std::string> remarks;  ///< below the results: accuracy on the virtual bench, refusals
};

/// One self-contained HTML page for an educator: what is good, what is not, when to redo it; then
/// figures and plots. Written whole. Throws Error.
void writePage(const PageHead& head, const std::vector<Result>& results,
               const std::filesystem::path& file);

}  // namespace palpa::calibrate

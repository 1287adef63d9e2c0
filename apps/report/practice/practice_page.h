#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/assess/progress/history.h"
#include "apps/report/page/html.h"

namespace palpa::report {

/// The frame of a page of practice: head, who, SIMULATED where any trial is, every kind of trial by
/// `series`, what was left out, footer.
struct PracticePage {
  std::string title, name;  ///< of the browser's tab: "Progress", "T017"
  std::string heading;
  /// name and value; what is empty is left out
  std::vector<std::pair<std::string, std::string>> who;
  std::string footer, software;
};
std::string practiceHtml(const PracticePage& page, std::vector<progress::PracticeTrial> trials,
                         const std::function<void(Html&, const progress::Series&)>& series);

/// "Subclavian access, force feedback off", and that it is simulated.
void writeSeriesHeading(Html& html, const progress::Series& series);

/// What the pages of practice need besides the usual style sheet.
std::string_view progressStyle();

}  // namespace palpa::report

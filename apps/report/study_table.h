#pragma once

#include <string>

#include "apps/report/html.h"
#include "apps/study_analysis/exhibit.h"

namespace palpa::report {

/// A table of a study for readers; scrolls where it is wider than the page.
void writeStudyTable(Html& html, const study_analysis::Table& table);

/// A number as its column wants it: decimals, "< 0.001" for small p-values, "–" for what does not
/// apply.
std::string studyCell(const study_analysis::Cell& cell, const study_analysis::Column& column);

std::string studyCsv(const study_analysis::Table& table, bool simulated);
std::string studyJson(const study_analysis::Exhibit& exhibit, bool simulated);

}  // namespace palpa::report

#pragma once

#include <string>
#include <vector>

#include "apps/study_analysis/comparison.h"
#include "apps/study_analysis/study_design.h"

namespace palpa::study_analysis {

/// Answers, a row each: what, both samples, difference with intervals, test, p and p after Holm,
/// effect.
Table comparisonTable(const std::vector<Comparison>& all);

/// The same in the published way: p one-tailed, trials counted as n.
Table publishedTable(const std::vector<Comparison>& all);

/// Why something was not tested, what puts a test in doubt; each sentence once.
std::vector<std::string> notesOf(const std::vector<Comparison>& all);

/// Mean, SD, n over subjects (a value each) of every group and condition, a row each, under
/// `metric`'s title.
void addCellRows(Table& table, const std::string& metric, const std::vector<StudyRow>& rows,
                 const StudyDesign& design);
std::vector<Column> cellColumns();

}  // namespace palpa::study_analysis

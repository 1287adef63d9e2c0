#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/page/page_parts.h"
#include "apps/study/analysis/exhibit.h"

namespace palpa::report {

struct StudyPage {
  study_analysis::StudyResult result;
  std::vector<Fact> sources;  ///< "Records", "Protocol", ...: where the rows came from
};

/// One self-contained HTML page of a study: what was found in sentences, what cannot be said,
/// figures with their tables, tests with their doubts, and beside them, where it was asked for, the
/// published way. All or nothing on disk.
void writeStudyReport(const StudyPage& page, const std::filesystem::path& file);

/// Tables of the page for other programs: <id>.csv and <id>.json of every table and figure, in
/// `folder`. Each row of a CSV ends with SIMULATED (1: rows of the study are simulated). JSON:
/// {"id", "title", "caption", "simulated", "columns": [{"name", "title"}], "rows": [[...]],
/// "notes": [...]}; null: does not apply. Returns the files, in the page's order.
std::vector<std::filesystem::path> writeStudyTables(const study_analysis::StudyResult& result,
                                                    const std::filesystem::path& folder);

}  // namespace palpa::report

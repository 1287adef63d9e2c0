#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/assess/progress/history.h"
#include "apps/assess/statistics/cusum.h"

namespace palpa::report {

/// What the page of a group is made from: the trials of all its trainees.
struct CohortReport {
  std::string group;  ///< the educator's name of it; empty: everybody
  std::string made_utc, software;
  statistics::CusumRates rates;
  std::vector<progress::PracticeTrial> trials;
};

/// One self-contained HTML page: in short, who needs attention, common errors, each trainee's
/// figures, the group's curves, reliability. Simulated trials and people's never share a figure.
/// All or nothing on disk.
void writeCohortReport(CohortReport report, const std::filesystem::path& file);

}  // namespace palpa::report

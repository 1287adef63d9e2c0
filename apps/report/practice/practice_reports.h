#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/assess/progress/history.h"
#include "apps/assess/statistics/cusum.h"

namespace palpa::report {

/// What the page of one trainee is made from: everything that the records have of the trainee's
/// trials.
struct TraineeReport {
  std::string trainee;  ///< pseudonym
  std::string group, experience;
  std::string made_utc;  ///< when the page was made
  std::string software;
  statistics::CusumRates rates;
  std::vector<progress::PracticeTrial> trials;
};

/// One self-contained HTML page: in short, learning curves, competence, retention, errors; each
/// kind of trial apart. All or nothing on disk.
void writeTraineeReport(const TraineeReport& report, const std::filesystem::path& file);

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

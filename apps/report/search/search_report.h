#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/assess/search/search_trial.h"
#include "apps/report/page/session_page.h"
#include "apps/report/page/subtask_table.h"
#include "apps/report/search/search_figures.h"

namespace palpa::report {

struct SearchReport : SessionPage {
  std::vector<assess::SearchTrial> trials;
  SubtaskMeanings subtasks;  ///< names as in the trials' doses, and what they mean
  std::vector<Picture> pictures;
  std::optional<SearchFigures> figures = {};  ///< of one episode
  std::string unit_note;  ///< how large the floor is: "1 U = 0.06 mm in the hand"
};

/// One self-contained HTML page: how often the target was found and how long that took, by
/// stiffness; what the cues gave back; what each part of the task was given; then each episode. All
/// or nothing on disk.
void writeSearchReport(const SearchReport& report, const std::filesystem::path& file);

/// trials.csv: header row, then one row an episode. No date, no path. Yes and no as 1 and 0.
///   USER_ID TRIAL SEED SIMULATED FF
///   OUTCOME                          done, time, aborted, void
///   BLOCK
///   MODE                             real, degraded, augmented
///   ORIENTATION_DEG
///   TARGET CHOSEN                    elements, 0 to 2; -1: none
///   FOUND TIME_S PATH_M MEAN_N PEAK_N
///   VISIT_0_S VISIT_1_S VISIT_2_S    on each element
/// and for every part of the task that the first episode has a dose of (without one, of
/// `parts_of_none`), <NAME> in capitals with _ for whatever is no letter or digit (empty in an
/// episode without that part):
///   <NAME>_ON_S <NAME>_TIMES <NAME>_AUGMENTED_S <NAME>_IMPULSE_NS
void writeSearchCsv(const std::string& user_id, const std::vector<assess::SearchTrial>& trials,
                    const std::filesystem::path& file,
                    const std::vector<assess::SubtaskDose>& parts_of_none = {});

}  // namespace palpa::report

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/assess/competence/verdict.h"
#include "apps/assess/needle/needle_views.h"
#include "apps/assess/needle/trial_assessment.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/page/session_page.h"
#include "apps/report/page/subtask_table.h"

namespace palpa::report {

/// Another trial, drawn beside this one.
struct BesideTrial {
  std::string label;                         ///< "expert": in the legend
  std::string words;                         ///< whose trial it is, a sentence
  std::vector<assess::TrialSample> samples;  ///< as below
};

struct TrialPage {
  assess::TrialAssessment assessment;
  /// about 100 Hz is plenty for the plots; empty where the report has `courses`
  std::vector<assess::TrialSample> samples;
  std::vector<Picture> pictures;
  std::optional<competence::Verdict> verdict = {};  ///< its checklist must outlive the page
  std::string certification = {};  ///< what so few trials cannot certify; beside a verdict
  BesideTrial beside = {};         ///< without samples: none
};

struct SessionReport : SessionPage {
  std::vector<TrialPage> trials;
  Courses<assess::TrialSample> courses = {};  ///< empty: the pages hold their samples
  /// registration error and its source, simulated truth named as such
  std::vector<Fact> registration;
  SubtaskSection parts;
  std::optional<assess::NeedleViews> views = {};  ///< none: the task teaches no way to a vein
};

/// Writes one self-contained HTML page (no network, no script needed to read it), trial by trial:
/// beside, then renamed.
void writeReport(const SessionReport& report, const std::filesystem::path& file);

/// trials.csv: header row, then one row a trial: USER_ID FF COL_LUNG COL_RIB COL_ART COL_VEIN
/// PHASE_1 PHASE_2 ECON_MEAN ECON_VAR TIME SUCCESS TRIAL SEED SIMULATED TOTAL AUGMENTED (cues were
/// added to the forces) RULES (the version that it was scored by), then of each part of the task
/// what subtaskColumns says (without a trial, of `parts_of_none`); empty: what a task with a goal
/// of its own has not. No date, path or host timing.
void writeTrialsCsv(const std::string& user_id, const std::vector<assess::TrialAssessment>& trials,
                    const std::filesystem::path& file,
                    const std::vector<assess::SubtaskDose>& parts_of_none = {});

}  // namespace palpa::report

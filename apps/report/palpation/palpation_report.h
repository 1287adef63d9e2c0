#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/assess/palpation/palpation_assessment.h"
#include "apps/report/page/session_page.h"
#include "apps/report/page/subtask_table.h"

namespace palpa::report {

struct PalpationPage {
  assess::PalpationAssessment assessment;
  /// about 100 Hz; empty where the report has `courses`
  std::vector<assess::PalpationSample> samples;
  assess::PalpationRules rules;
  std::vector<Picture> pictures;
  bool estimated = false;  ///< what the second finger presses with is no sensor's
};

struct PalpationReport : SessionPage {
  std::string force_note;  ///< "Scaled force: ..."; shown near the top; empty: none
  std::vector<PalpationPage> trials;
  Courses<assess::PalpationSample> courses = {};  ///< empty: the pages hold their samples
  assess::PalpationStandard standard;
  SubtaskSection parts;
};

/// One self-contained HTML page: over all trials, then each trial, then what it was done with. All
/// or nothing on disk.
void writePalpationReport(const PalpationReport& report, const std::filesystem::path& file);

/// trials.csv: header row, then one row a trial. No date, no path. Lengths in mm, forces in N,
/// shares from 0 to 1, yes and no as 1 and 0; empty: there was nothing to measure.
///   USER_ID TRIAL SEED SIMULATED
///   FF                               force feedback
///   OUTCOME                          done, time, aborted, void
///   LUMPS FOUND MISSED               of the case
///   FALSE_ALARMS
///   REPEATED                         marks of a lump that had been found
///   CLEAR_QUADRANTS                  quarters without a lump
///   WRONG_QUADRANTS                  those of them that a false alarm calls ill
///   ILL_QUADRANTS                    quarters with a lump in them
///   HIT_QUADRANTS                    those of them with a lump that was found
///   COVERAGE_LIGHT COVERAGE_MEDIUM COVERAGE_DEEP     felt at this pressure or a deeper one
///   TWICE                            felt again
///   PATTERN PATTERN_KEPT PEAK_N MEAN_N
///   TOO_LIGHT TOO_HARD               of the time of touching
///   CLOSER_FORCE                     mean peak of closer looks over that of searching presses
///   PRESSES TIME_S
///   GUIDED                           of the time
///   ERROR_MEAN_MM                    between mark and lump, of the lumps found
///   SIZE_ERROR_MEAN_MM               said less true, with sign, of those graded
///   AT_STANDARD                      this trial; nobody passes by one
///   AUGMENTED                        cues were added to the forces
/// then of each part of the task what subtaskColumns says (without a trial, of `parts_of_none`).
void writePalpationCsv(const std::string& user_id,
                       const std::vector<assess::PalpationAssessment>& trials,
                       const std::filesystem::path& file,
                       const std::vector<assess::SubtaskDose>& parts_of_none = {});

}  // namespace palpa::report

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/assess/statistics/tests_of_means.h"
#include "apps/study/analysis/study_design.h"

namespace palpa::study_analysis {

/// What one subject of the search study improved by, from the block "baseline" to the block
/// "evaluation".
struct SearchSubject {
  std::string subject, training;  ///< training: what the block "training" was done with
  double success_before = 0, success_after = 0;  ///< shares, 0 to 1
  double seconds_before = 0, seconds_after = 0;  ///< mean duration of a trial
  double improvement = 0;                        ///< success_after - success_before
  double decrease = 0;  ///< (seconds_before - seconds_after) / seconds_before
  double improvement_sd = 0,
         decrease_sd = 0;  ///< the same over the standard deviation of all subjects
  double sum() const { return improvement_sd + decrease_sd; }
  double largest() const { return improvement_sd > decrease_sd ? improvement_sd : decrease_sd; }
};

/// One analysis of variance between the kinds of training.
struct SearchAnova {
  std::string id, title;
  std::vector<std::vector<double>> groups;  ///< by kind of training
  std::optional<statistics::Anova> anova;   ///< none: see why_not
  double p_holm = 1;
  std::string why_not;
};

/// Source: Edmunds and Pai, "Perceptually augmented simulator design", IEEE Transactions on Haptics
/// 5(1), 2012, section 4.
struct SearchStudy {
  std::vector<std::string> trainings;
  std::vector<SearchSubject> subjects;
  std::vector<std::string> left_out;  ///< without baseline or evaluation
  std::vector<SearchAnova> anovas;    ///< success, duration, sum, largest
};

/// What was trained with: the groups, or where there is but one, the conditions of the block
/// "training". Throws UsageError where blocks or figures (success, time_s) are missing.
SearchStudy searchStudyOf(const std::vector<StudyRow>& rows, const StudyDesign& design);

StudyResult analyseSearchStudy(const std::vector<StudyRow>& rows, const StudyDesign& design);

/// Parts of it.
std::vector<Exhibit> searchFigures(const std::vector<StudyRow>& rows, const StudyDesign& design,
                                   const SearchStudy& study);
Exhibit anovaTable(const StudyDesign& design, const SearchStudy& study);
std::vector<std::string> searchFindings(const StudyDesign& design, const SearchStudy& study);

}  // namespace palpa::study_analysis

#pragma once

#include <string>
#include <vector>

#include "apps/assess/statistics/sample.h"
#include "apps/study/analysis/study_row.h"

namespace palpa::study_analysis {

/// A figure over the trials of one subject under one condition, in order; trials to which it does
/// not apply are left out.
struct SubjectSeries {
  std::string subject, group, condition;
  std::vector<int> trials;  ///< 1, 2, ... among this subject's trials under this condition
  std::vector<double> values;
};

/// By subject and condition, as they first appear; without empty ones.
std::vector<SubjectSeries> seriesOf(const std::vector<StudyRow>& rows, const std::string& metric);

/// Those of a group under a condition; an empty text: any.
std::vector<SubjectSeries> within(const std::vector<SubjectSeries>& all, const std::string& group,
                                  const std::string& condition);

/// One value a subject: the mean of his trials.
std::vector<double> subjectMeans(const std::vector<SubjectSeries>& series);

/// All trials, as if they were independent: only for the published way.
std::vector<double> pooledTrials(const std::vector<SubjectSeries>& series);

/// Mean of the first two and of the last two trials of a subject.
struct Learning {
  std::string subject;
  double first = 0, last = 0;
  std::vector<double> first_trials, last_trials;
};

inline constexpr std::size_t kTrialsToLearn = 4;  ///< fewer do not have a first two and a last two

/// Of each subject with four trials or more.
std::vector<Learning> learningOf(const std::vector<SubjectSeries>& series);

std::vector<double> firstOf(const std::vector<Learning>& all);
std::vector<double> lastOf(const std::vector<Learning>& all);

/// What a figure is called in tables and sentences: "Time, s".
std::string metricTitle(const std::string& metric);
std::string metricUnit(const std::string& metric);  ///< "s"; "" for a plain number

}  // namespace palpa::study_analysis

#pragma once

#include <string>
#include <vector>

#include "apps/assess/progress/cohort.h"
#include "apps/assess/progress/competence.h"
#include "apps/assess/progress/history.h"
#include "apps/report/page/html.h"
#include "apps/report/page/style.h"

namespace palpa::report {

/// Good: success. Guide: success, but a failure by harm or passes. Bad: no success.
Tone toneOfPractice(const progress::PracticeTrial& trial);

/// One mark a trial; the fitted curve with its band where there are trials enough; the table
/// behind. Nothing where no trial has the figure.
void writeLearningChart(Html& html, const progress::Series& series, const std::string& metric);

/// Share of successes in blocks of five with Wilson's intervals; the table behind.
void writeSuccessChart(Html& html, const progress::Series& series);

/// The sum after each trial between its two limits; the table behind.
void writeCusumChart(Html& html, const progress::Series& series,
                     const progress::Competence& competence);

/// Of how many of a trainee's trials each error is, one row an error.
void writeCommonErrors(Html& html, const std::vector<progress::CommonError>& errors);

/// A figure of every trainee: latest trials, mean, interval; the group's mean as a line.
void writeTraineeFigures(Html& html, const progress::Series& group, const std::string& metric);

/// Every trainee's trials as a thin line, the group's mean with its interval over them.
void writeGroupCurve(Html& html, const progress::Series& group, const std::string& metric);

}  // namespace palpa::report

#pragma once

#include <string>
#include <vector>

#include "apps/assess/progress/cohort.h"
#include "apps/assess/progress/competence.h"
#include "apps/assess/progress/history.h"
#include "apps/assess/statistics/cusum.h"
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
void writeGroupCurve(Html& html, const progress::GroupCurve& curve, const std::string& metric);

/// What an educator reads in a minute: how much, what got better, what costs most, nearest misses,
/// what recurs, what to practise next.
void writeTraineeSummary(Html& html, const progress::Series& series);

/// "34 scored trials in 5 sessions, 2027-01-10 to 2027-03-02 (51 days)"
std::string extentOf(const progress::Series& series);

/// The parts of a trainee's page after the summary.
void writeLearningSection(Html& html, const progress::Series& series);
/// CUSUM and what may be said by it; of palpation only from eight cases on.
void writeCompetenceSection(Html& html, const progress::Series& series,
                            const statistics::CusumRates& rates);
/// Tests to come, and what pauses cost.
void writeRetentionSection(Html& html, const progress::Series& series,
                           const statistics::CusumRates& rates);
void writeErrorSection(Html& html, const progress::Series& series);

}  // namespace palpa::report

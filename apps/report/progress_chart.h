#pragma once

#include <string>

#include "apps/assess/progress/competence.h"
#include "apps/assess/progress/history.h"
#include "apps/report/html.h"
#include "apps/report/tone.h"

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

}  // namespace palpa::report

#pragma once

#include <string>

#include "apps/assess/trial_assessment.h"
#include "apps/report/html.h"
#include "apps/report/tone.h"

namespace palpa::report {

/// Reaching the vein is not all: a puncture of lung or artery on the way is a serious error that
/// the rest of a good performance does not make up for.
bool hasComplication(const assess::TrialAssessment& assessment);

/// "Successful", "Vein reached, with a complication", "Not successful: time limit reached", ...
std::string outcomeWords(const assess::TrialAssessment& assessment);
std::string shortOutcome(const assess::TrialAssessment& assessment);  ///< for tables
Tone toneOfOutcome(const assess::TrialAssessment& assessment);

/// "Most points: Lung touched (500.0), Time (315.2) and ...": the largest two or three; the third
/// only when it is at least a tenth of the total. "" when nothing was charged.
std::string largestReasons(const assess::TrialAssessment& assessment);

/// Outcome, summary, reasons, total; then the plain figures of the trial.
void writeVerdict(Html& html, const assess::TrialAssessment& assessment);

}  // namespace palpa::report

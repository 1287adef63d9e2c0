#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/assess/needle/needle_views.h"
#include "apps/assess/needle/trial_assessment.h"
#include "apps/report/needle/session_report.h"
#include "apps/report/page/html.h"
#include "apps/report/page/style.h"

namespace palpa::report {

/// One trial: verdict, where the needle went, score, course, near misses, pictures. `views`: null
/// where the task teaches no way to a vein.
void writeTrialSection(Html& html, const TrialPage& page, const assess::NeedleViews* views);

/// Reaching the vein is not all: a puncture of lung or artery on the way is a serious error that
/// the rest of a good performance does not make up for.
bool hasComplication(const assess::TrialAssessment& assessment);

/// "Successful", "Vein reached, with a complication", "Not successful: time limit reached", ...
std::string outcomeWords(const assess::TrialAssessment& assessment);
std::string shortOutcome(const assess::TrialAssessment& assessment);  ///< for tables
Tone toneOfOutcome(const assess::TrialAssessment& assessment);

/// "Most points: Lung touched (500.0), Time (315.2) and ...": the largest two or three; the third
/// only when it is at least a tenth of the total. "" when nothing was charged. Where the summary
/// has told the first: "Then: Time (315.2).", or nothing.
std::string largestReasons(const assess::TrialAssessment& assessment, bool first_told = false);

/// Outcome, summary, reasons, total; then the plain figures of the trial.
void writeVerdict(Html& html, const assess::TrialAssessment& assessment);

/// Largest points first; equal ones as they came.
std::vector<assess::Penalty> byPoints(std::vector<assess::Penalty> penalties);

/// Each penalty: title, reason with its moments, value x weight = points, a bar; then the total.
void writeScoreTable(Html& html, const assess::TrialAssessment& assessment);

/// How close the tip came to pleura and artery, with the moment, in words and on a scale from 5 mm
/// inside to 20 mm away.
void writeNearMisses(Html& html, const assess::TrialAssessment& assessment);

/// Which of the six common errors were made, when, and why that matters; then pass or fail with its
/// reasons, and the checklist with what was done, not done, did not arise, or nobody has judged.
/// Nothing for a trial that was judged by no expert path.
void writeCompetence(Html& html, const TrialPage& page);

std::string_view competenceStyle();

/// Where each pass went in, its way in section, and what it was aimed at.
void writeTrack(Html& html, const assess::NeedleViews& views,
                const std::vector<assess::TrialSample>& samples);
std::string_view trackStyle();

/// All trials of the session: total per trial as a line, then a table. For two trials or more.
void writeOverview(Html& html, const std::vector<TrialPage>& trials);

/// A penalty code in the words of a clinical teacher.
struct Code {
  std::string_view code, meaning;
};

/// "What these numbers mean", with the source.
void writeGlossary(Html& html);

}  // namespace palpa::report

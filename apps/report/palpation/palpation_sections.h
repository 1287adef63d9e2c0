#pragma once

#include <string>
#include <string_view>

#include "apps/report/page/html.h"
#include "apps/report/page/style.h"
#include "apps/report/palpation/palpation_report.h"

namespace palpa::report {

/// "At the standard", "Below the standard: time limit reached", "Not judged: void", ...
std::string palpationVerdict(const assess::PalpationAssessment& trial);
Tone toneOfPalpation(const assess::PalpationAssessment& trial);

/// One trial: verdict, advice, map, force, lumps, figures, pictures.
void writePalpationSection(Html& html, const PalpationPage& page);

/// Each lump: where and how large it is, whether it was found, how far off place, size and grading
/// were. Then what the false alarms are.
void writeLumpTable(Html& html, const PalpationPage& page);

/// Coverage, pattern, forces, time.
void writePalpationFigures(Html& html, const PalpationPage& page);

/// Over all trials that count (scored, not void): lumps found, sensitivity and specificity with
/// their intervals, false alarms; and whether that is a pass.
void writePalpationTotals(Html& html, const std::vector<PalpationPage>& trials,
                          const assess::PalpationStandard& standard);

/// What sensitivity, specificity and the other words of the page mean, with sources.
void writePalpationGlossary(Html& html);

/// What a page of palpation needs beside the style sheet of all pages; its colours are that one's.
std::string_view palpationStyle();

}  // namespace palpa::report

#pragma once

#include <string>

#include "apps/report/html.h"
#include "apps/report/palpation_report.h"
#include "apps/report/tone.h"

namespace palpa::report {

/// "At the standard", "Below the standard: time limit reached", "Not judged: void", ...
std::string palpationVerdict(const assess::PalpationAssessment& trial);
Tone toneOfPalpation(const assess::PalpationAssessment& trial);

/// One trial: verdict, advice, map, force, lumps, figures, pictures.
void writePalpationSection(Html& html, const PalpationPage& page);

}  // namespace palpa::report

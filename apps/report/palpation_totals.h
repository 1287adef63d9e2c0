#pragma once

#include "apps/report/html.h"
#include "apps/report/palpation_report.h"

namespace palpa::report {

/// Over all trials that count (scored, not void): lumps found, sensitivity and specificity with
/// their intervals, false alarms; and whether that is a pass.
void writePalpationTotals(Html& html, const std::vector<PalpationPage>& trials,
                          const assess::PalpationStandard& standard);

/// What sensitivity, specificity and the other words of the page mean, with sources.
void writePalpationGlossary(Html& html);

}  // namespace palpa::report

#pragma once

#include "apps/assess/squeeze/discrimination.h"
#include "apps/report/html.h"

namespace palpa::report {

/// How much more than the other, of a ratio: "25 %" of 1.25.
std::string percentMore(double ratio);

/// Shares of right answers with their 95 % intervals over how much more the one had, and what
/// chance would give.
void writeSqueezeChart(Html& html, const assess::Discrimination& answers, const char* what);

}  // namespace palpa::report

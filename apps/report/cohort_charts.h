#pragma once

#include <string>
#include <vector>

#include "apps/assess/progress/cohort.h"
#include "apps/report/html.h"

namespace palpa::report {

/// Of how many of a trainee's trials each error is, one row an error.
void writeCommonErrors(Html& html, const std::vector<progress::CommonError>& errors);

/// A figure of every trainee: latest trials, mean, interval; the group's mean as a line.
void writeTraineeFigures(Html& html, const progress::Series& group, const std::string& metric);

/// Every trainee's trials as a thin line, the group's mean with its interval over them.
void writeGroupCurve(Html& html, const progress::Series& group, const std::string& metric);

}  // namespace palpa::report

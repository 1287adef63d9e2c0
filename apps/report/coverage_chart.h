#pragma once

#include <string>

#include "apps/report/html.h"
#include "apps/report/palpation_report.h"

namespace palpa::report {

/// The name of a lump in picture and table: A, B, ...
std::string lumpName(std::size_t index);

/// The searched area from above as the trainee saw it: how firmly each cell has been felt, where
/// lumps are, what was marked. Drawn wide and narrow.
void writeCoverageChart(Html& html, const PalpationPage& page);

}  // namespace palpa::report

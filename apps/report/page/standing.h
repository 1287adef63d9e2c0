#pragma once

#include <vector>

#include "apps/assess/progress/standing.h"
#include "apps/report/page/html.h"
#include "apps/training/engine.h"

namespace palpa::report {

/// How a session's trials stand beside others who did the same: of each figure that is shown, at
/// most five, a bar with the reach of every group, and marks where these trials are. Nothing where
/// no group or no trial has a figure.
void writeStanding(Html& html, training::Engine engine,
                   const std::vector<progress::JudgedTrial>& trials,
                   const std::vector<progress::Group>& groups);

}  // namespace palpa::report

#pragma once

#include <vector>

#include "apps/assess/search/search_trial.h"
#include "apps/report/html.h"
#include "apps/report/tone.h"

namespace palpa::report {

/// Good: the target was found; bad: another element was chosen; guide: none was. Decides colour and
/// shape.
Tone toneOfEpisode(const assess::SearchTrial& trial);

/// Share of episodes in which the target was found, by block and mode, with its 95 % interval, and
/// what chance would give.
void writeFoundChart(Html& html, const std::vector<assess::SearchTally>& tallies);

/// How long every episode took, by block and mode, and how it ended; void ones are left out.
/// Nothing where there is none.
void writeSearchTimes(Html& html, const std::vector<assess::SearchTrial>& trials);

}  // namespace palpa::report

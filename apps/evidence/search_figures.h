#pragma once

#include "apps/record/session_file.h"
#include "apps/report/search/search_figures.h"

namespace palpa::evidence {

/// Pictures of a searched floor as its evidence has it, and of the probe's way over it. `trial` 0:
/// the first finished episode in which a cue could be felt, else the first that was finished.
/// Throws UsageError for a session that searched no floor, and for a trial that it does not have or
/// finish.
report::SearchFigures searchFigures(const record::SessionReader& reader, int trial = 0);

/// Whether there is an episode to draw.
bool hasSearchFigures(const record::SessionReader& reader);

}  // namespace palpa::evidence

#pragma once

#include "apps/report/html.h"
#include "apps/report/search_report.h"

namespace palpa::report {

/// The three elements from above, in their true places: the target filled, the chosen one ringed.
/// Words for those who do not see it.
void writePlaceSign(Html& html, const assess::SearchTrial& trial);

/// Every episode: how it was rendered, where its target lay, what was chosen, and with how much
/// time, way and force.
void writeEpisodes(Html& html, const SearchReport& report);

/// What each part of the task was given, by stiffness, over all episodes but the void.
void writeDoses(Html& html, const SearchReport& report);

/// What search, degraded, augmented and the other words of the page mean.
void writeSearchGlossary(Html& html);

}  // namespace palpa::report

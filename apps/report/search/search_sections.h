#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/assess/search/search_trial.h"
#include "apps/report/page/html.h"
#include "apps/report/page/style.h"
#include "apps/report/search/search_report.h"

namespace palpa::report {

/// "full stiffness", "degraded stiffness", "degraded, with cues": short, for tables and charts.
const char* stiffnessWords(assess::SearchMode mode);

/// "In 10 of 10 episodes with full stiffness the target was found, 95 % interval 72 % to 100 %. The
/// choice took 21 s (median)."
std::string foundSentence(const assess::SearchTally& tally);

/// What the cues gave back, in words; "" where there were no cues.
std::string recoverySentence(const std::vector<assess::SearchTrial>& trials, std::uint64_t seed);

/// All of it, and the chart of shares, in a card.
void writeSearchFindings(Html& html, const std::vector<assess::SearchTrial>& trials);

/// Good: the target was found; bad: another element was chosen; guide: none was. Decides colour and
/// shape.
Tone toneOfEpisode(const assess::SearchTrial& trial);

/// Share of episodes in which the target was found, by block and mode, with its 95 % interval, and
/// what chance would give.
void writeFoundChart(Html& html, const std::vector<assess::SearchTally>& tallies);

/// How long every episode took, by block and mode, and how it ended; void ones are left out.
/// Nothing where there is none.
void writeSearchTimes(Html& html, const std::vector<assess::SearchTrial>& trials);

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

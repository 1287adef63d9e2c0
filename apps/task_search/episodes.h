#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/task_search/search_file.h"

namespace palpa::task_search {

/// One episode: how it is rendered and what is searched.
struct Episode {
  std::string block;
  assess::SearchMode mode = assess::SearchMode::real;
  haptics::SearchStimulus stimulus;
  std::uint64_t seed = 1;  ///< of the bumps: one texture for a session
};

/// `count` episodes in one mode; orientation and target by chance, the same for the same seed
/// whatever the mode, so that modes can be compared. Bumps are generated once for a session.
std::vector<Episode> episodesOf(std::uint64_t seed, int count, assess::SearchMode mode);
/// All of the task's blocks: training in `mode`, the others with full stiffness.
std::vector<Episode> blocksOf(const SearchSettings& task, std::uint64_t seed,
                              assess::SearchMode mode);

/// As its event in the record says it, and read again. Throws Error for words that are none.
std::string episodeText(const Episode& episode);
Episode episodeIn(const std::string& text);

/// What is under the hand in an episode.
haptics::SearchSurface surfaceOf(const haptics::SearchSpec& spec, const Episode& episode);

}  // namespace palpa::task_search

#include "apps/task_search/episodes.h"

#include <nlohmann/json.hpp>
#include <numbers>

#include "anatomy/geometry/error.h"
#include "apps/runtime/random.h"

namespace palpa::task_search {
namespace {

/// Draws go on from block to block: no stimulus comes twice.
std::vector<Episode> drawn(runtime::RandomStream& random, std::uint64_t seed, int count,
                           assess::SearchMode mode, const std::string& block) {
  std::vector<Episode> episodes;
  for (int i = 0; i < count; ++i) {
    Episode e{block, mode, {}, seed};
    e.stimulus.orientation =
        random.uniform(0, 2 * std::numbers::pi / haptics::SearchSurface::kElements);
    e.stimulus.target = static_cast<int>(random.uniform() * haptics::SearchSurface::kElements) %
                        haptics::SearchSurface::kElements;
    episodes.push_back(e);
  }
  return episodes;
}

}  // namespace

std::vector<Episode> episodesOf(std::uint64_t seed, int count, assess::SearchMode mode) {
  runtime::RandomStream random(seed, "search.episodes");
  return drawn(random, seed, count, mode, "");
}

std::vector<Episode> blocksOf(const SearchSettings& task, std::uint64_t seed,
                              assess::SearchMode mode) {
  runtime::RandomStream random(seed, "search.episodes");
  std::vector<Episode> all;
  for (const SearchBlock& block : task.blocks) {
    const std::vector<Episode> some = drawn(
        random, seed, block.episodes, block.training ? mode : assess::SearchMode::real, block.name);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

std::string episodeText(const Episode& e) {
  return nlohmann::json{{"block", e.block},
                        {"mode", assess::name(e.mode)},
                        {"orientation", e.stimulus.orientation},
                        {"target", e.stimulus.target},
                        {"seed", e.seed}}
      .dump();
}

Episode episodeIn(const std::string& text) {
  const auto damaged = [](const std::string& why) {
    return Error("does not describe an episode (" + why + ")", "event \"case\"",
                 "Restore the file from a backup");
  };
  try {
    const nlohmann::json said = nlohmann::json::parse(text);
    const auto mode = assess::searchModeOf(said.at("mode").get<std::string>());
    const int target = said.at("target").get<int>();
    if (!mode || target < 0 || target >= haptics::SearchSurface::kElements)
      throw damaged("unknown mode or target");
    return {said.at("block").get<std::string>(),
            *mode,
            {said.at("orientation").get<double>(), target},
            said.at("seed").get<std::uint64_t>()};
  } catch (const nlohmann::json::exception& e) {
    throw damaged(e.what());
  }
}

haptics::SearchSurface surfaceOf(const haptics::SearchSpec& spec, const Episode& episode) {
  runtime::RandomStream random(episode.seed, "search.bumps");
  return haptics::SearchSurface(spec, episode.stimulus, [&random] { return random.uniform(); });
}

}  // namespace palpa::task_search

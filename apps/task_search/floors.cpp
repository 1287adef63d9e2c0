#include "apps/task_search/floors.h"

#include <chrono>
#include <numbers>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/random.h"
#include "apps/task_search/valley_lines.h"

namespace palpa::task_search {
namespace {

/// Draws go on from block to block: no stimulus comes twice.
std::vector<Episode> drawn(RandomStream& random, std::uint64_t seed, int count,
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
  RandomStream random(seed, "search.episodes");
  return drawn(random, seed, count, mode, "");
}

std::vector<Episode> blocksOf(const SearchSettings& task, std::uint64_t seed,
                              assess::SearchMode mode) {
  RandomStream random(seed, "search.episodes");
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
    const nlohmann::json said = parseJson(text);
    const auto mode = assess::searchModeOf(said.at("mode").get<std::string>());
    const int target = said.at("target").get<int>();
    if (!mode || target < 0 || target >= haptics::SearchSurface::kElements)
      throw damaged("unknown mode or target");
    return {said.at("block").get<std::string>(),
            *mode,
            {said.at("orientation").get<double>(), target},
            said.at("seed").get<std::uint64_t>()};
  } catch (const nlohmann::json::exception& e) {
    throw damaged(whyNoJson(text, e));
  }
}

haptics::SearchSurface surfaceOf(const haptics::SearchSpec& spec, const Episode& episode) {
  RandomStream random(episode.seed, "search.bumps");
  return haptics::SearchSurface(spec, episode.stimulus, [&random] { return random.uniform(); });
}

namespace {

constexpr double kFarthestReach = 5;  // U, where an attraction says none

double reachOf(const SearchSettings& task) {
  double reach = 0;
  for (const double r : task.augmentations.reach_U) reach = std::max(reach, r);
  return reach > 0 ? reach : kFarthestReach;
}

}  // namespace

std::unique_ptr<MadeFloor> makeFloor(const SearchSettings& task, const Episode& episode) {
  auto made = std::make_unique<MadeFloor>(MadeFloor{surfaceOf(task.spec, episode), {}, {}});
  if (episode.mode != assess::SearchMode::augmented) return made;
  const HeightField height = [&surface = made->surface](double x, double y) {
    return surface.smoothHeight(x, y);
  };
  made->rises =
      riseTable(heightMap(height, task.map_px, task.spec.side), task.spec.side, task.rise_share);
  made->valleys.emplace(valleyPoints(height, {task.spec.side}), task.spec.side, reachOf(task));
  return made;
}

void Floors::prepare(std::uint32_t number) {
  FloorSlot& s = slot(number);
  if (number < 1 || number > episodes_.size() || s.coming == number) return;
  s.number.store(0, std::memory_order_release);
  if (s.making.valid()) s.making.wait();
  s.coming = number;
  s.making = std::async(std::launch::async,
                        [this, number] { return makeFloor(task_, episodes_[number - 1]); });
}

bool Floors::ready(std::uint32_t number, bool wait) {
  FloorSlot& s = slot(number);
  if (s.number.load(std::memory_order_acquire) == number) return true;
  if (s.coming != number || !s.making.valid()) return false;
  if (!wait && s.making.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return false;
  s.made = s.making.get();
  s.floor = s.made->floor();
  s.number.store(number, std::memory_order_release);
  return true;
}

const haptics::Floor* Floors::floor(std::uint32_t number) const noexcept {
  const FloorSlot& s = slots_[number % slots_.size()];
  return s.number.load(std::memory_order_acquire) == number ? &s.floor : nullptr;
}

}  // namespace palpa::task_search

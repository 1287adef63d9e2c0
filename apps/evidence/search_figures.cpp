#include "apps/evidence/search_figures.h"

#include <algorithm>
#include <numbers>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "apps/evidence/recorded_trials.h"
#include "apps/task_search/floor_maps.h"

namespace palpa::evidence {
namespace {

constexpr int kSmoothPixels = 320, kFloorPixels = 480, kDiscPixels = 270;
constexpr int kMostResponsePixels = 512;
/// The source's figure 5: 0.589 rad, sigma = 2^4 px.
constexpr int kShownDirection = 3, kShownScale = 4;
constexpr double kShownAspect = 0.5;
constexpr double kDiscMargin = 2;  // U around a disc

report::MapValues mapOf(const task_search::SquareMap& map) {
  const double half = map.side / 2;
  return {map.size, map.size, map.x - half, map.x + half, map.y - half, map.y + half, map.values};
}

report::TexturedDisc discOf(const haptics::SearchSurface& surface, int element) {
  const auto [x, y] = surface.middle(element);
  const haptics::BumpSpec& bumps = surface.texture(element).spec();
  const auto height = [&, x = x, y = y](double u, double v) {
    return surface.height(x + u, y + v);
  };
  const double side = 2 * (surface.spec().disc + kDiscMargin);
  return {mapOf(task_search::mapOf(height, kDiscPixels, side)), bumps.radius, bumps.spacing,
          bumps.jitter};
}

/// The filter that is shown, on a map that is not larger than a picture: half the pixels and a
/// scale less are the same filter on the floor.
struct ShownFilter {
  int pixels, scale = kShownScale;
  explicit ShownFilter(int map_px) : pixels(map_px) {
    for (; pixels > kMostResponsePixels && pixels % 2 == 0 && scale > 0; --scale) pixels /= 2;
  }
};

void drawFloor(const task_search::SearchSettings& task, const task_search::Episode& episode,
               report::SearchFigures* figures) {
  const haptics::SearchSurface surface = task_search::surfaceOf(task.spec, episode);
  const double side = task.spec.side;
  const task_search::FloorHeights smooth = [&](double x, double y) {
    return surface.smoothHeight(x, y);
  };
  const int target = surface.stimulus().target,
            other = (target + 1) % haptics::SearchSurface::kElements;
  figures->smooth = mapOf(task_search::mapOf(smooth, kSmoothPixels, side));
  figures->floor = mapOf(task_search::mapOf(
      [&](double x, double y) { return surface.height(x, y); }, kFloorPixels, side));
  figures->target = discOf(surface, target);
  figures->distractor = discOf(surface, other);
  const ShownFilter filter(task.map_px);
  figures->filter = {
      mapOf(task_search::filterMap(kShownDirection, filter.scale, filter.pixels, side)),
      2 * std::numbers::pi * kShownDirection / haptics::GaborTable::kDirections,
      (1 << filter.scale) * side / filter.pixels, kShownAspect};
  figures->response =
      mapOf(task_search::responseMap(smooth, kShownDirection, filter.scale, filter.pixels, side));
  for (int e = 0; e < haptics::SearchSurface::kElements; ++e)
    figures->elements.push_back({surface.middle(e)[0], surface.middle(e)[1], e == target, false});
}

/// Where the probe was while it was free, as often as a picture can show.
std::vector<report::ProbePlace> wayOf(const record::SessionReader& reader, int trial) {
  const haptics::TickConfig& config = reader.info().tick_config;
  const Pose X_FD = unpack(config.X_DF).inverse();
  std::vector<report::ProbePlace> way;
  reader.ticks([&](const haptics::FlightRecord& tick) {
    if (tick.commands.trial != static_cast<std::uint32_t>(trial) || tick.commands.held ||
        !tick.commands.armed)
      return;
    const Vec3 p = X_FD * task_search::tipOf(config, tick.reading) / config.floor.unit;
    way.push_back({p.x(), p.y(), (tick.place & haptics::kPlaceTouching) != 0, tick.augmenting});
  });
  return way;
}

/// Finished episodes and what their events say of them, in their order.
struct ShownEpisode {
  record::RecordedTrial trial;
  task_search::Episode episode;
};
std::vector<ShownEpisode> finishedEpisodes(const record::SessionReader& reader) {
  std::vector<ShownEpisode> all;
  const std::vector<runtime::Event> events = reader.events();
  for (const record::RecordedTrial& trial : reader.trials()) {
    const auto said = std::find_if(events.begin(), events.end(), [&](const runtime::Event& e) {
      return e.trial == trial.header.trial && e.is(runtime::EventKind::trial_case);
    });
    if (trial.ended && said != events.end())
      all.push_back({trial, task_search::episodeIn(said->text)});
  }
  return all;
}

ShownEpisode chosenOf(const std::vector<ShownEpisode>& all, int number) {
  const auto found = std::find_if(all.begin(), all.end(), [number](const ShownEpisode& e) {
    return number > 0 ? e.trial.header.trial == number
                      : e.episode.mode == assess::SearchMode::augmented;
  });
  if (found != all.end()) return *found;
  if (number == 0 && !all.empty()) return all.front();
  throw UsageError(
      number > 0 ? "has no finished episode " + std::to_string(number) : "has no finished episode",
      "session", "Choose another one");
}

int chosenElement(const std::string& scores_json) {
  const nlohmann::json scores = nlohmann::json::parse(scores_json, nullptr, false);
  return scores.is_object() && scores.contains("CHOSEN") && scores["CHOSEN"].is_number_integer()
             ? scores["CHOSEN"].get<int>()
             : -1;
}

}  // namespace

bool hasSearchFigures(const record::SessionReader& reader) {
  return engineOf(reader) == training::Engine::search && !finishedEpisodes(reader).empty();
}

report::SearchFigures searchFigures(const record::SessionReader& reader, int number) {
  if (engineOf(reader) != training::Engine::search)
    throw UsageError("is no search: there is no floor to be drawn", "session",
                     "Give the session of palpa search; --pictures shows trials of every task");
  const ShownEpisode shown = chosenOf(finishedEpisodes(reader), number);
  const task_search::SearchSettings task =
      task_search::readSearch(JsonFile::ofText(reader.info().task_json, "the recorded task"));
  report::SearchFigures figures;
  figures.trial = shown.trial.header.trial;
  figures.mode = assess::name(shown.episode.mode);
  figures.unit_mm = 1e3 * reader.info().tick_config.floor.unit;
  drawFloor(task, shown.episode, &figures);
  const int chosen = chosenElement(shown.trial.end.scores_json);
  for (std::size_t e = 0; e < figures.elements.size(); ++e)
    figures.elements[e].chosen = static_cast<int>(e) == chosen;
  figures.way = wayOf(reader, figures.trial);
  for (const station::NamedPart& cue : task.augmentations.augmentations)
    figures.cues.push_back(cue.name);
  return figures;
}

}  // namespace palpa::evidence

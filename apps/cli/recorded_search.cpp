#include "apps/cli/recorded_search.h"

#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "anatomy/geometry/error.h"
#include "apps/cli/recorded_palpation.h"

namespace palpa::cli {
namespace {

task_search::SearchSettings recordedTask(const record::SessionReader& reader) {
  return task_search::readSearch(
      station::JsonFile(nlohmann::json::parse(reader.info().task_json), "the recorded task"));
}

std::map<int, task_search::Episode> recordedEpisodes(const record::SessionReader& reader) {
  std::map<int, task_search::Episode> episodes;
  for (const runtime::Event& event : reader.events())
    if (event.kind == "case") episodes[event.trial] = task_search::episodeIn(event.text);
  return episodes;
}

/// The floor that was asked for last, and what it is made of.
struct LastFloor {
  task_search::SearchSettings task;
  std::map<int, task_search::Episode> episodes;
  std::uint32_t number = 0;
  std::unique_ptr<task_search::MadeFloor> made;
  haptics::Floor floor;

  const haptics::Floor* of(std::uint32_t asked) {
    if (asked == number) return &floor;
    const auto episode = episodes.find(static_cast<int>(asked));
    if (episode == episodes.end())
      throw Error("names floor " + std::to_string(asked) + ", of which nothing is said", "session",
                  "Restore the file from a backup");
    made = makeFloor(task, episode->second);
    floor = made->floor();
    number = asked;
    return &floor;
  }
};

}  // namespace

std::vector<RecordedSearch> recordedSearches(const record::SessionReader& reader) {
  const task_search::SearchSettings task = recordedTask(reader);
  const haptics::TickConfig& tick = reader.info().tick_config;
  const std::map<int, task_search::Episode> episodes = recordedEpisodes(reader);
  const bool simulated = nlohmann::json::parse(reader.info().session_json).value("simulated", true);
  task_search::SearchListener listener(task, tick.augmentations);
  std::vector<RecordedSearch> trials;
  const std::vector<record::RecordedTrial> recorded = reader.trials();
  auto trial = recorded.begin();
  const auto begin = [&] {
    if (trial != recorded.end()) listener.begin(static_cast<std::uint32_t>(trial->header.trial));
  };
  const auto finish = [&] {
    const auto episode = episodes.find(trial->header.trial);
    if (episode == episodes.end())
      throw Error("says nothing of episode " + std::to_string(trial->header.trial), "session",
                  "Restore the file from a backup");
    assess::SearchTrial facts;
    facts.trial = trial->header.trial;
    facts.role = trial->header.role;
    facts.simulated = simulated;
    facts.force_feedback = trial->header.force_feedback;
    facts.seed = trial->header.seed;
    facts.outcome = trial->end.outcome;
    trials.push_back({*trial, task_search::judged(facts, episode->second, listener)});
    ++trial;
    begin();
  };
  begin();
  reader.ticks([&](const haptics::FlightRecord& record) {
    while (trial != recorded.end() &&
           record.commands.trial > static_cast<std::uint32_t>(trial->header.trial))
      finish();
    if (trial == recorded.end() || (trial->ended && record.t_ns > trial->end.t_ns)) return;
    listener.add(record, task_search::tipOf(tick, record.reading));
  });
  while (trial != recorded.end()) finish();
  return trials;
}

std::function<const haptics::Floor*(std::uint32_t number)> recordedFloors(
    const record::SessionReader& reader) {
  if (engineOf(reader) != "surface") return {};
  const auto last = std::make_shared<LastFloor>();
  last->task = recordedTask(reader);
  last->episodes = recordedEpisodes(reader);
  return [last](std::uint32_t number) { return last->of(number); };
}

}  // namespace palpa::cli

#include "apps/cli/recorded_squeeze.h"

#include <nlohmann/json.hpp>

#include "anatomy/geometry/error.h"

namespace palpa::cli {
namespace {

/// What the record says of a trial besides its ticks.
struct SaidOfSqueeze {
  task_squeeze::Comparison comparison;
  int answer = 0;
};

SaidOfSqueeze saidOf(const std::vector<runtime::Event>& events, int trial) {
  SaidOfSqueeze said;
  for (const runtime::Event& event : events) {
    if (event.trial != trial) continue;
    if (event.kind == "case") said.comparison = task_squeeze::comparisonIn(event.text);
    if (event.kind == "answer") said.answer = event.value == 1 ? 1 : event.value == 2 ? 2 : 0;
  }
  return said;
}

}  // namespace

std::vector<RecordedSqueeze> recordedSqueezes(const record::SessionReader& reader) {
  const station::JsonFile task(nlohmann::json::parse(reader.info().task_json), "the recorded task");
  task_squeeze::SqueezeListener listener(task.number("force/touch_N", 0.02, 5));
  const std::vector<runtime::Event> events = reader.events();
  std::vector<RecordedSqueeze> trials;
  const std::vector<record::RecordedTrial> recorded = reader.trials();
  auto trial = recorded.begin();
  SaidOfSqueeze said;
  const auto begin = [&] {
    if (trial == recorded.end()) return;
    said = saidOf(events, trial->header.trial);
    listener.begin(static_cast<std::uint32_t>(trial->header.trial), said.comparison);
  };
  const auto finish = [&] {
    assess::SqueezeTrial facts;
    facts.trial = trial->header.trial;
    facts.role = trial->header.role;
    facts.simulated = true;
    facts.force_feedback = trial->header.force_feedback;
    facts.seed = trial->header.seed;
    facts.outcome = trial->end.outcome;
    trials.push_back({*trial, task_squeeze::judged(facts, said.comparison, listener, said.answer)});
    ++trial;
    begin();
  };
  begin();
  reader.ticks([&](const haptics::FlightRecord& record) {
    while (trial != recorded.end() &&
           record.commands.trial > static_cast<std::uint32_t>(trial->header.trial))
      finish();
    if (trial == recorded.end() || (trial->ended && record.t_ns > trial->end.t_ns)) return;
    listener.add(record);
  });
  while (trial != recorded.end()) finish();
  return trials;
}

}  // namespace palpa::cli

#include "apps/cli/recorded_palpation.h"

#include <nlohmann/json.hpp>

#include "anatomy/geometry/error.h"

namespace palpa::cli {
namespace {

/// One field of what a record describes; `otherwise` where it has none.
template <class Value>
Value fieldOf(const std::string& text, const char* field, const Value& otherwise,
              const char* what) {
  try {
    return nlohmann::json::parse(text).value(field, otherwise);
  } catch (const nlohmann::json::exception&) {
    throw Error("the session's description is damaged", what, "Restore the file from a backup");
  }
}

/// What the record says of a trial besides its ticks.
struct Said {
  std::vector<assess::CaseLump> lumps;
  std::vector<runtime::Event> grades;
};

Said saidIn(const std::vector<runtime::Event>& events, int trial) {
  Said said;
  for (const runtime::Event& event : events) {
    if (event.trial != trial) continue;
    if (event.kind == "case") said.lumps = task_palpation::caseOf(event.text);
    if (event.kind == "grade") said.grades.push_back(event);
  }
  return said;
}

}  // namespace

std::string engineOf(const record::SessionReader& reader) {
  return fieldOf(reader.info().task_json, "engine", std::string("needle"), "its task");
}

std::vector<RecordedPalpation> recordedPalpations(const record::SessionReader& reader) {
  const task_palpation::Scoring scoring = task_palpation::scoringOf(
      station::JsonFile(nlohmann::json::parse(reader.info().task_json), "the recorded task"));
  const bool simulated = fieldOf(reader.info().session_json, "simulated", false, "its session");
  const std::vector<runtime::Event> events = reader.events();
  std::vector<RecordedPalpation> trials;
  task_palpation::PalpationListener listener(reader.info().tick_config);
  std::vector<record::RecordedTrial> recorded = reader.trials();
  auto trial = recorded.begin();
  Said said;
  const auto begin = [&] {
    if (trial == recorded.end()) return;
    said = saidIn(events, trial->header.trial);
    listener.begin(static_cast<std::uint32_t>(trial->header.trial));
  };
  const auto finish = [&] {
    const runtime::TrialHeader& header = trial->header;
    for (const runtime::Event& grade : said.grades) {
      const trial::Grade told = trial::gradeOf(grade.text);
      if (grade.value >= 1 && grade.value <= static_cast<double>(listener.marks().size()))
        listener.grade(told.diameter, told.hardness, told.mobility,
                       static_cast<std::size_t>(grade.value));
    }
    const double guided = trial->ended && !trial->end.scores_json.empty()
                              ? fieldOf(trial->end.scores_json, "GUIDED", 0.0, "a trial's score")
                              : 0;
    const assess::PalpationFacts facts{
        header.trial, header.role,        simulated, header.force_feedback,
        header.seed,  trial->end.outcome, guided};
    trials.push_back(
        {*trial, assess::assessPalpation(facts, scoring.rules, scoring.standard, said.lumps,
                                         listener.samples(), listener.marks())});
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

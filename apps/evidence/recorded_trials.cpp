#include "apps/evidence/recorded_trials.h"

#include <map>
#include <memory>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/json_text.h"
#include "apps/assess/dose_counter.h"
#include "apps/record/session_file.h"
#include "apps/station/task_sections.h"
#include "apps/training/engine.h"
#include "apps/training/trial_words.h"

namespace palpa::evidence {

using runtime::EventKind;
using training::Engine;

namespace {

/// What the record's frame says of a trial.
template <class Trial>
Trial factsOf(const record::RecordedTrial& trial, bool simulated) {
  Trial facts;
  facts.trial = trial.header.trial;
  facts.role = training::roleNamed(trial.header.role);
  facts.simulated = simulated;
  facts.force_feedback = trial.header.force_feedback;
  facts.seed = trial.header.seed;
  facts.outcome = training::outcomeNamed(trial.end.outcome);
  return facts;
}

/// One field of what a record describes; `otherwise` where it has none.
template <class Value>
Value fieldOf(const std::string& text, const char* field, const Value& otherwise,
              const char* what) {
  try {
    return parseJson(text).value(field, otherwise);
  } catch (const nlohmann::json::exception&) {
    throw Error("the session's description is damaged", what, "Restore the file from a backup");
  }
}

/// What the record says of a trial besides its ticks.
struct Said {
  std::vector<assess::CaseLump> lumps;
  bool taken_away = false;
  std::vector<runtime::Event> grades;
};

Said saidIn(const std::vector<runtime::Event>& events, int trial) {
  Said said;
  for (const runtime::Event& event : events) {
    if (event.trial != trial) continue;
    if (event.is(EventKind::trial_case)) {
      said.lumps = task_palpation::caseOf(event.text);
      said.taken_away = task_palpation::takenIn(event.text);
    }
    if (event.is(EventKind::grade)) said.grades.push_back(event);
  }
  return said;
}

}  // namespace

Engine engineOf(const record::SessionReader& reader) {
  const std::string name =
      fieldOf(reader.info().task_json, "engine", std::string("needle"), "its task");
  return training::engineNamed(name).value_or(Engine::needle);
}

namespace {

using VisitPalpation =
    std::function<void(const record::RecordedTrial&, task_palpation::PalpationListener&)>;

void walkPalpation(const record::SessionReader& reader, const record::TrialVisitor& besides,
                   const VisitPalpation& visit) {
  task_palpation::PalpationListener listener(reader.info().tick_config, reader.info().pair_config);
  record::walkTrials(
      reader, reader.trials(),
      {.begin =
           [&](const record::RecordedTrial& trial) {
             listener.begin(static_cast<std::uint32_t>(trial.header.trial));
             if (besides.begin) besides.begin(trial);
           },
       .tick =
           [&](const haptics::FlightRecord& record) {
             listener.add(record);
             if (besides.tick) besides.tick(record);
           },
       .finish = [&](const record::RecordedTrial& trial) { visit(trial, listener); }});
}

/// What was said of the marks, after them.
void giveGrades(const std::vector<runtime::Event>& grades,
                task_palpation::PalpationListener& listener) {
  for (const runtime::Event& grade : grades) {
    const trial::Grade told = trial::gradeOf(grade.text);
    if (grade.value >= 1 && grade.value <= static_cast<double>(listener.marks().size()))
      listener.grade(told.diameter, told.hardness, told.mobility,
                     static_cast<std::size_t>(grade.value));
  }
}

/// What all trials of a palpation have in common.
struct PalpationInWords {
  task_palpation::Scoring scoring;
  bool simulated = false, augmented = false;
  std::vector<runtime::Event> events;
  explicit PalpationInWords(const record::SessionReader& reader)
      : scoring(task_palpation::scoringOf(
            JsonFile::ofText(reader.info().task_json, "the recorded task"))),
        simulated(fieldOf(reader.info().session_json, "simulated", false, "its session")),
        augmented(fieldOf(reader.info().session_json, "augment", false, "its session")),
        events(reader.events()) {}

  assess::PalpationAssessment judged(const record::RecordedTrial& trial,
                                     task_palpation::PalpationListener& listener) const {
    const runtime::TrialHeader& header = trial.header;
    const Said said = saidIn(events, header.trial);
    giveGrades(said.grades, listener);
    const double guided = trial.ended && !trial.end.scores_json.empty()
                              ? fieldOf(trial.end.scores_json, "GUIDED", 0.0, "a trial's score")
                              : 0;
    const assess::PalpationFacts facts{
        header.trial,   training::roleNamed(header.role),          simulated, header.force_feedback,
        header.seed,    training::outcomeNamed(trial.end.outcome), guided,    augmented,
        said.taken_away};
    return assess::assessPalpation(facts, scoring.rules, scoring.standard, said.lumps,
                                   listener.samples(), listener.marks());
  }
};

}  // namespace

void eachPalpation(const record::SessionReader& reader, const VisitPalpation& visit) {
  walkPalpation(reader, {}, visit);
}

std::vector<RecordedPalpation> recordedPalpations(const record::SessionReader& reader) {
  const PalpationInWords session(reader);
  assess::TrialDoses doses(
      reader.info().tick_config.augmentations,
      station::readPlan(JsonFile::ofText(reader.info().task_json, "the recorded task"))
          .subtaskNames());
  std::vector<RecordedPalpation> trials;
  walkPalpation(
      reader,
      {.begin =
           [&](const record::RecordedTrial& trial) {
             doses.begin(static_cast<std::uint32_t>(trial.header.trial));
           },
       .tick =
           [&](const haptics::FlightRecord& record) {
             if (record.tool == 0) doses.add(record);
           },
       .finish = {}},
      [&](const record::RecordedTrial& trial, task_palpation::PalpationListener& listener) {
        trials.push_back({trial, session.judged(trial, listener)});
        trials.back().assessment.doses = doses.doses();
      });
  return trials;
}

namespace {

task_search::SearchSettings recordedTask(const record::SessionReader& reader) {
  return task_search::readSearch(JsonFile::ofText(reader.info().task_json, "the recorded task"));
}

std::map<int, task_search::Episode> recordedEpisodes(const record::SessionReader& reader) {
  std::map<int, task_search::Episode> episodes;
  for (const runtime::Event& event : reader.events())
    if (event.is(EventKind::trial_case)) episodes[event.trial] = task_search::episodeIn(event.text);
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
      throw Error("names floor " + std::to_string(asked) + ", which it does not describe",
                  "session", "Restore the file from a backup");
    made = makeFloor(task, episode->second);
    floor = made->floor();
    number = asked;
    return &floor;
  }
};

}  // namespace

std::vector<RecordedSearch> recordedSearches(const record::SessionReader& reader) {
  const task_search::SearchSettings task = recordedTask(reader);
  const haptics::TickConfig& config = reader.info().tick_config;
  const std::map<int, task_search::Episode> episodes = recordedEpisodes(reader);
  const bool simulated =
      JsonFile::ofText(reader.info().session_json, "the recorded session").flag("simulated", true);
  task_search::SearchListener listener(task, config.augmentations);
  std::vector<RecordedSearch> trials;
  const auto begin = [&](const record::RecordedTrial& trial) {
    listener.begin(static_cast<std::uint32_t>(trial.header.trial));
  };
  const auto tick = [&](const haptics::FlightRecord& record) {
    listener.add(record, task_search::tipOf(config, record.reading));
  };
  const auto finish = [&](const record::RecordedTrial& trial) {
    const auto episode = episodes.find(trial.header.trial);
    if (episode == episodes.end())
      throw Error("does not describe episode " + std::to_string(trial.header.trial), "session",
                  "Restore the file from a backup");
    auto facts = factsOf<assess::SearchTrial>(trial, simulated);
    trials.push_back({trial, task_search::judged(facts, episode->second, listener)});
  };
  record::walkTrials(reader, reader.trials(), {begin, tick, finish});
  return trials;
}

std::function<const haptics::Floor*(std::uint32_t number)> recordedFloors(
    const record::SessionReader& reader) {
  if (engineOf(reader) != Engine::search) return {};
  const auto last = std::make_shared<LastFloor>();
  last->task = recordedTask(reader);
  last->episodes = recordedEpisodes(reader);
  return [last](std::uint32_t number) { return last->of(number); };
}

namespace {

/// What the record says of a trial besides its ticks.
struct SaidOfComparison {
  task_comparison::Comparison comparison;
  task_comparison::Answer answer;
};

SaidOfComparison saidOf(const std::vector<runtime::Event>& events, int trial) {
  SaidOfComparison said;
  for (const runtime::Event& event : events) {
    if (event.trial != trial) continue;
    if (event.is(EventKind::trial_case))
      said.comparison = task_comparison::comparisonIn(event.text);
    if (event.is(EventKind::answer))
      said.answer.add(event.value, said.comparison.factors.size() > 2);
  }
  return said;
}

}  // namespace

std::vector<RecordedComparison> recordedComparisons(const record::SessionReader& reader) {
  const JsonFile task = JsonFile::ofText(reader.info().task_json, "the recorded task");
  const bool simulated = fieldOf(reader.info().session_json, "simulated", true, "its session");
  task_comparison::ComparisonListener listener(task.number("force/touch_N", 0.02, 5),
                                               task_comparison::toolsFor(engineOf(reader)));
  const std::vector<runtime::Event> events = reader.events();
  std::vector<RecordedComparison> trials;
  SaidOfComparison said;
  const auto begin = [&](const record::RecordedTrial& trial) {
    said = saidOf(events, trial.header.trial);
    listener.begin(static_cast<std::uint32_t>(trial.header.trial), said.comparison);
  };
  const auto tick = [&](const haptics::FlightRecord& record) { listener.add(record); };
  const auto finish = [&](const record::RecordedTrial& trial) {
    auto facts = factsOf<assess::ComparisonTrial>(trial, simulated);
    trials.push_back(
        {trial, task_comparison::judged(facts, said.comparison, listener, said.answer)});
  };
  record::walkTrials(reader, reader.trials(), {begin, tick, finish});
  return trials;
}

namespace {

/// The same of a pulse.
struct SaidOfPulse {
  task_pulse::PulseCase patient;
  task_pulse::PulseAnswer answer;
};

SaidOfPulse saidOfPulse(const std::vector<runtime::Event>& events, int trial) {
  SaidOfPulse said;
  for (const runtime::Event& event : events) {
    if (event.trial != trial) continue;
    if (event.is(EventKind::trial_case)) said.patient = task_pulse::caseIn(event.text);
    if (event.is(EventKind::answer)) said.answer.add(event.value);
  }
  return said;
}

}  // namespace

std::vector<RecordedPulse> recordedPulses(const record::SessionReader& reader) {
  const bool simulated = fieldOf(reader.info().session_json, "simulated", true, "its session");
  task_pulse::PulseListener listener(
      reader.info().tick_config,
      task_pulse::rulesIn(JsonFile::ofText(reader.info().task_json, "the recorded task")));
  const std::vector<runtime::Event> events = reader.events();
  std::vector<RecordedPulse> trials;
  const auto begin = [&](const record::RecordedTrial& trial) {
    listener.begin(static_cast<std::uint32_t>(trial.header.trial));
  };
  const auto tick = [&](const haptics::FlightRecord& record) { listener.add(record); };
  const auto finish = [&](const record::RecordedTrial& trial) {
    const SaidOfPulse said = saidOfPulse(events, trial.header.trial);
    auto facts = factsOf<assess::PulseTrial>(trial, simulated);
    trials.push_back({trial, task_pulse::judged(facts, said.patient, listener, said.answer)});
  };
  record::walkTrials(reader, reader.trials(), {begin, tick, finish});
  return trials;
}

}  // namespace palpa::evidence

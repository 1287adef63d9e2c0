#include "apps/cli/practice_records.h"

#include <map>
#include <nlohmann/json.hpp>

#include "anatomy/geometry/error.h"

namespace palpa::cli {
namespace {

/// What makes a trial unlike others of its task: a search's stiffness, cues, guidance.
std::string conditionOf(const record::TrialWithSession& stored) {
  const nlohmann::json facts = nlohmann::json::parse(stored.session.facts_json),
                       score = stored.trial.score_json.empty()
                                   ? nlohmann::json::object()
                                   : nlohmann::json::parse(stored.trial.score_json);
  std::string condition = score.value("MODE", "");
  const auto also = [&](const char* words) {
    condition += (condition.empty() ? "" : ", ") + std::string(words);
  };
  if (facts.value("augment", false)) also("cues on");
  if (const auto guided = score.find("GUIDED");
      guided != score.end() &&
      (guided->is_boolean() ? guided->get<bool>() : guided->get<double>() > 0))
    also("guided");
  return condition;
}

}  // namespace

progress::PracticeTrial practiceOf(const record::TrialWithSession& stored,
                                   const std::string& group) {
  progress::PracticeTrial t;
  for (const record::Metric& m : stored.trial.metrics) t.metrics.push_back({m.name, m.value});
  t.trainee = stored.session.trainee;
  t.group = group;
  t.engine = progress::engineOfFigures(t.metrics);
  t.task = stored.session.task;
  t.started_utc = stored.session.started_utc;
  t.arrival = stored.session.arrival;
  t.number = stored.trial.number;
  t.role = stored.trial.role;
  t.outcome = stored.trial.outcome;
  t.simulated = stored.session.simulated;
  t.force_feedback = stored.trial.force_feedback;
  try {
    t.condition = conditionOf(stored);
  } catch (const nlohmann::json::exception& e) {
    throw Error(std::string("a session's description is damaged (") + e.what() + ")",
                "session " + stored.session.uuid, "Restore the records from a backup");
  }
  return t;
}

std::vector<progress::PracticeTrial> practiceIn(record::RecordStore& store,
                                                const PracticeChoice& choice) {
  std::map<std::string, std::string> groups;
  for (const record::Trainee& trainee : store.trainees()) groups[trainee.id] = trainee.group;
  record::TrialFilter filter;
  filter.trainee = choice.trainee;
  filter.task = choice.task;
  std::vector<progress::PracticeTrial> practice;
  for (const record::TrialWithSession& stored : store.trials(filter)) {
    const std::string& group = groups[stored.session.trainee];
    if (choice.group.empty() || group == choice.group)
      practice.push_back(practiceOf(stored, group));
  }
  return practice;
}

}  // namespace palpa::cli

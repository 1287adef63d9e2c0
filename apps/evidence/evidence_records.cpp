#include "apps/evidence/evidence_records.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/sha256.h"
#include "apps/assess/comparison/comparison_trial.h"
#include "apps/assess/needle/assess_trial.h"
#include "apps/assess/needle/needle_metrics.h"
#include "apps/assess/palpation/palpation_assessment.h"
#include "apps/assess/pulse/pulse_trial.h"
#include "apps/assess/search/search_trial.h"
#include "apps/evidence/recorded_session.h"
#include "apps/evidence/recorded_trials.h"
#include "apps/record/store/delivery.h"
#include "apps/training/engine.h"
#include "apps/training/trial_words.h"

namespace palpa::evidence {

using training::Engine;

namespace {

using Figures = std::map<int, std::vector<metrics::MetricValue>>;  ///< by trial

Figures needleFigures(const std::filesystem::path& evidence) {
  const RecordedSession session(evidence);
  Figures figures;
  session.eachTrial([&](const record::RecordedTrial& trial,
                        const RecordedSession::Samples& samples) {
    const bool judged = trial.ended && !training::isVoid(trial.end.outcome) &&
                        (session.hasGoal() || !session.reader().info().expert_path_json.empty());
    if (judged) figures[trial.header.trial] = session.rescore(trial, samples).metrics;
  });
  return figures;
}

template <class Trials, class Judge>
Figures figuresOf(const Trials& trials, Judge judge) {
  Figures figures;
  for (const auto& trial : trials)
    if (trial.recorded.ended && !training::isVoid(trial.recorded.end.outcome))
      figures[trial.recorded.header.trial] = judge(trial);
  return figures;
}

Figures figuresIn(const record::SessionReader& reader, const std::filesystem::path& evidence) {
  switch (engineOf(reader)) {
    case Engine::palpation:
      return figuresOf(recordedPalpations(reader), [](const RecordedPalpation& t) {
        return assess::palpationMetrics(t.assessment);
      });
    case Engine::search:
      return figuresOf(recordedSearches(reader),
                       [](const RecordedSearch& t) { return assess::searchMetrics(t.again); });
    case Engine::squeeze:
    case Engine::friction:
      return figuresOf(recordedComparisons(reader), [](const RecordedComparison& t) {
        return assess::comparisonMetrics(t.again);
      });
    case Engine::pulse: {
      const assess::PulseRules rules =
          task_pulse::rulesIn(JsonFile::ofText(reader.info().task_json, "the recorded task"));
      return figuresOf(recordedPulses(reader), [&rules](const RecordedPulse& t) {
        return assess::pulseMetrics(t.again, rules);
      });
    }
    case Engine::needle:
      break;
  }
  return needleFigures(evidence);
}

/// Of the station's calibrations, as the station's file had them.
std::vector<record::StoredCalibration> calibrationsIn(const nlohmann::json& station) {
  std::vector<record::StoredCalibration> all;
  for (const nlohmann::json& c : station.value("calibrations", nlohmann::json::array()))
    all.push_back(
        {c.value("kind", ""), c.value("date", ""), c.value("sha256", ""), c.value("verdict", "")});
  return all;
}

/// What was trained, whichever command led to it: a needle's task by its id, other tasks by the
/// command of their kind.
std::string taskOf(const record::SessionReader& reader) {
  const Engine engine = engineOf(reader);
  if (engine != Engine::needle) return training::nameOf(engine);
  const nlohmann::json task = parsedOrDiscarded(reader.info().task_json);
  return task.is_object() && task.contains("id") && task["id"].is_string()
             ? task["id"].get<std::string>()
             : reader.info().command;
}

/// What the session's report says is for its report only.
std::string withoutReport(const std::string& text, nlohmann::json session) {
  return session.erase("report") > 0 ? session.dump() : text;
}

record::StoredSession sessionIn(const record::SessionReader& reader,
                                const std::filesystem::path& evidence) {
  const record::SessionInfo& info = reader.info();
  const nlohmann::json session = parseJson(info.session_json),
                       station = parseJson(info.station_json);
  record::StoredSession s;
  s.uuid = info.uuid;
  s.trainee = session.value("trainee", "");
  s.started_utc = info.started_utc;
  s.software = info.software;
  s.task = taskOf(reader);
  s.station = station.value("id", "");
  s.simulated = session.value("simulated", false);
  if (const nlohmann::json study = session.value("study", nlohmann::json::object());
      !study.empty()) {
    s.study = study.at("id");
    s.slot = study.at("slot");
  }
  s.evidence = std::filesystem::absolute(evidence).string();
  s.evidence_sha256 = sha256OfFile(evidence);
  s.facts_json = withoutReport(info.session_json, session);
  s.calibrations = calibrationsIn(station);
  return s;
}

record::StoredTrial trialIn(const record::RecordedTrial& t, const Figures& figures) {
  record::StoredTrial trial;
  trial.number = t.header.trial;
  trial.start_ns = t.header.t_ns;
  trial.end_ns = t.end.t_ns;
  trial.role = t.header.role;
  trial.seed = t.header.seed;
  trial.force_feedback = t.header.force_feedback;
  trial.outcome = t.end.outcome;
  trial.reason = t.end.reason;
  trial.score_json = t.end.scores_json;
  if (const auto known = figures.find(t.header.trial); known != figures.end())
    for (const metrics::MetricValue& m : known->second) trial.metrics.push_back({m.name, m.value});
  trial.success = trial.metric("success") == 1;
  return trial;
}

}  // namespace

EvidenceRecords recordsOf(const std::filesystem::path& evidence) {
  const record::SessionReader reader(evidence);
  EvidenceRecords records;
  try {
    records.session = sessionIn(reader, evidence);
  } catch (const nlohmann::json::exception& e) {
    throw Error(
        "the session's description is damaged (" + whyNoJson(reader.info().session_json, e) + ")",
        evidence.string(), "Restore the file from a backup");
  }
  const Figures figures = figuresIn(reader, evidence);
  for (const record::RecordedTrial& t : reader.trials()) {
    if (t.ended)
      records.trials.push_back(trialIn(t, figures));
    else
      ++records.unfinished;
  }
  for (const runtime::Event& e : reader.events())
    for (record::StoredTrial& trial : records.trials)
      if (trial.number == e.trial && !e.is(runtime::EventKind::picture))
        trial.events.push_back({e.t_ns, e.kind, e.text, e.value});
  return records;
}

std::string absoluteRecords(const std::string& url) {
  record::requireAddress(url);
  return record::isServer(url) ? url : std::filesystem::absolute(url).lexically_normal().string();
}

EvidenceDelivery deliverEvidence(const std::filesystem::path& evidence, const std::string& url,
                                 const record::Patience& patience) {
  const EvidenceRecords records = recordsOf(evidence);
  record::PendingList pending(record::PendingList::usualFolder());
  pending.note({records.session.uuid, evidence, absoluteRecords(url)});
  EvidenceDelivery done{records.session.trainee, {}, records.unfinished};
  try {
    done.trials = record::deliver(url, records.session, records.trials, patience);
  } catch (const record::PersonDeleted&) {
    pending.forget(records.session.uuid);
    throw;
  }
  pending.forget(records.session.uuid);
  return done;
}

std::string conditionOf(const PracticeCondition& of) {
  std::string condition = of.mode;
  const auto also = [&](const std::string& words) {
    condition += (condition.empty() ? "" : ", ") + words;
  };
  if (of.rules != assess::kNewestRules)
    also(of.rules == assess::kPublishedRules ? "scored as published" : "rules " + of.rules);
  if (of.cues_on) also("cues on");
  if (of.guided) also("guided");
  return condition;
}

namespace {

/// Trials as they come, those of a session after one another: what its description says and which
/// figures there are is looked up once for all that share it.
class Practice {
 public:
  progress::PracticeTrial of(const record::TrialWithSession& stored);
  /// Of its task's file; of a needle's session that does not say it what it is filed under.
  const std::string& taskId(const record::StoredSession& session) {
    readSession(session);
    return task_id_;
  }

 private:
  void readSession(const record::StoredSession& session);
  void readNames(const std::vector<record::Metric>& metrics);
  std::string conditionOf(const record::StoredTrial& trial, bool by_path) const;

  std::string session_, task_id_;
  bool cues_on_ = false;
  std::vector<std::string> names_;  ///< of the metrics
  std::vector<std::size_t> numbers_;
  std::optional<Engine> engine_;
};

void Practice::readSession(const record::StoredSession& session) {
  if (session.uuid == session_) return;
  const nlohmann::json facts = parseJson(session.facts_json);
  cues_on_ = facts.value("augment", false);
  task_id_ = facts.value("task", session.task);
  session_ = session.uuid;
}

void Practice::readNames(const std::vector<record::Metric>& metrics) {
  if (std::equal(metrics.begin(), metrics.end(), names_.begin(), names_.end(),
                 [](const record::Metric& m, const std::string& name) { return m.name == name; }))
    return;
  names_.clear();
  numbers_.clear();
  for (const record::Metric& m : metrics) {
    names_.push_back(m.name);
    numbers_.push_back(progress::keptNumber(m.name));
  }
  engine_ = progress::engineOfFigures(names_);
}

std::string Practice::conditionOf(const record::StoredTrial& trial, bool by_path) const {
  const nlohmann::json score =
      trial.score_json.empty() ? nlohmann::json::object() : parseJson(trial.score_json);
  const auto guided = score.find("GUIDED");
  return evidence::conditionOf(
      {score.value("MODE", ""), by_path ? score.value("RULES", "1") : assess::kNewestRules,
       cues_on_,
       guided != score.end() &&
           (guided->is_boolean() ? guided->get<bool>() : guided->get<double>() > 0)});
}

progress::PracticeTrial Practice::of(const record::TrialWithSession& stored) {
  readNames(stored.trial.metrics);
  progress::PracticeTrial t;
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    t.figures.set(numbers_[i], stored.trial.metrics[i].value);
  t.trainee = stored.session.trainee;
  t.engine = engine_;
  t.task = stored.session.task;
  t.started_utc = stored.session.started_utc;
  t.arrival = stored.session.arrival;
  t.number = stored.trial.number;
  t.role = training::roleNamed(stored.trial.role);
  t.outcome = training::outcomeNamed(stored.trial.outcome);
  t.simulated = stored.session.simulated;
  t.force_feedback = stored.trial.force_feedback;
  try {
    readSession(stored.session);
    t.condition = conditionOf(stored.trial, std::isfinite(t.metric("total")));
  } catch (const nlohmann::json::exception& e) {
    throw Error(
        "a session's description is damaged (" + whyNoJson(stored.session.facts_json, e) + ")",
        "session " + stored.session.uuid, "Restore the records from a backup");
  }
  return t;
}

}  // namespace

std::vector<progress::PracticeTrial> practiceIn(record::RecordStore& store,
                                                const PracticeChoice& choice) {
  std::set<std::string> group;
  if (!choice.group.empty())
    for (const record::Trainee& trainee : store.trainees())
      if (trainee.group == choice.group) group.insert(trainee.id);
  std::vector<progress::PracticeTrial> all;
  Practice practice;
  record::TrialFilter filter;
  filter.trainee = choice.trainee;
  filter.task = training::taskIdOf(choice.task);
  filter.simulated = choice.simulated;
  store.eachTrial(filter, [&](const record::TrialWithSession& stored) {
    if (choice.without_studies && !stored.session.study.empty()) return;
    const auto& out = choice.left_out;
    if (std::find(out.begin(), out.end(), stored.session.study) != out.end()) return;
    if (!choice.task_id.empty() && practice.taskId(stored.session) != choice.task_id) return;
    if (choice.group.empty() || group.contains(stored.session.trainee))
      all.push_back(practice.of(stored));
  });
  return all;
}

}  // namespace palpa::evidence

#include "apps/session/session_records.h"

#include <cstdio>

#include <nlohmann/json.hpp>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "apps/assess/needle/assess_trial.h"
#include "apps/evidence/evidence_records.h"
#include "apps/evidence/expert_ranges.h"
#include "apps/training/engine.h"

namespace palpa::session {
namespace {

constexpr char kNobody[] = "T000";
constexpr record::Patience kBriefly{2, 300'000'000};  // a person waits

void requireInRecords(SessionOptions& o) {
  o.records = evidence::absoluteRecords(o.records);
  record::PendingList::usualFolder();  // without one it is said now, not once the session is on
  try {
    record::RecordStore store(o.records);
    if (const auto trainee = store.trainee(o.trainee)) {
      if (trainee->consent_utc.empty())
        std::printf(
            "No consent of %s to training records is noted; where it was given: palpa records "
            "trainee change --id %s --consent\n",
            o.trainee.c_str(), o.trainee.c_str());
      return;
    }
    if (o.trainee != kNobody)
      throw UsageError("is not in the " + store.place(), "trainee " + o.trainee,
                       "Add the trainee first: palpa records trainee add --id " + o.trainee +
                           " --records " + o.records + "; or run without records");
    std::printf(
        "This session is nobody's and will not be in the records: --trainee says whose it is\n");
    o.records.clear();
  } catch (const record::StoreUnreachable& e) {
    o.records_reached = false;
    std::fprintf(stderr, "palpa: %s\n", e.what());
  }
}

using training::Engine;

/// How this session's trials will be filed, among those of its task; none: they differ among
/// themselves.
std::optional<std::string> conditionOf(const SessionOptions& o, Engine engine,
                                       const nlohmann::json& task) {
  if (o.blocks) return std::nullopt;
  const std::string mode = engine == Engine::search ? o.mode : o.sort ? "put in order" : "";
  const nlohmann::json scoring = task.value("scoring", nlohmann::json::object());
  const std::string rules = scoring.is_object() && scoring.contains("rules")
                                ? scoring["rules"].get<std::string>()
                                : assess::kNewestRules;
  return evidence::conditionOf(
      {mode, engine == Engine::needle ? rules : assess::kNewestRules, o.augment, false});
}

/// As the shipped sessions of experts were held.
bool isAsShipped(const SessionOptions& o) {
  return o.force_feedback && !o.augment && !o.guidance && !o.sort && !o.blocks && o.tools == 1 &&
         o.mode == SessionOptions().mode;
}

}  // namespace

void checkTrainee(SessionOptions& o) {
  if (!o.records.empty()) requireInRecords(o);
  if (!o.film_room.empty() && o.who == OperatorKind::person && o.records.empty())
    throw UsageError("is somebody's, and goes with that person's records", "--film-room",
                     "Say who trains: --trainee, with --records");
}

void meetOthers(SessionOptions& o, bool simulated, const std::string& task_json) {
  if (!o.report) return;
  const nlohmann::json task = parseJson(task_json);
  const std::string id = task.value("id", "");
  const auto engine = training::engineNamed(task.value("engine", "needle"));
  try {
    if (const auto experts = evidence::shippedExperts(id); experts && isAsShipped(o))
      o.others.push_back(*experts);
    const auto condition = engine ? conditionOf(o, *engine, task) : std::nullopt;
    if (o.records.empty() || !o.records_reached || !condition) return;
    record::RecordStore store(o.records);
    evidence::PracticeChoice choice;
    choice.task = *engine == Engine::needle ? id : training::nameOf(*engine);
    choice.task_id = id;
    choice.simulated = simulated ? 1 : 0;
    choice.without_studies = true;  // what a blind study drew is nobody's to know
    for (const progress::Series& series : progress::seriesOf(evidence::practiceIn(store, choice)))
      if (series.condition == *condition && series.force_feedback == o.force_feedback)
        if (const auto others = progress::othersIn(series, o.trainee)) o.others.push_back(*others);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "palpa: the report may show nobody beside (%s)\n", firstLine(e).c_str());
  }
}

std::vector<progress::Group> othersBeside(const record::SessionInfo& info) {
  std::vector<progress::Group> groups;
  const nlohmann::json session = parseJson(info.session_json);
  const nlohmann::json report = session.value("report", nlohmann::json::object());
  for (const nlohmann::json& group : report.value("others", nlohmann::json::array()))
    groups.push_back(progress::groupIn(group));
  return groups;
}

std::unique_ptr<record::PendingHold> noteForRecords(const SessionOptions& o,
                                                    const std::string& uuid,
                                                    const std::filesystem::path& evidence) {
  if (o.records.empty()) return nullptr;
  record::PendingList pending(record::PendingList::usualFolder());
  pending.note({uuid, evidence, o.records});
  return pending.hold(uuid);
}

void deliverSession(const SessionOptions& o, const std::filesystem::path& folder) {
  if (o.records.empty()) return;
  if (!o.quiet) std::fprintf(stderr, "Bringing the trials into the records ...\n");
  try {
    const evidence::EvidenceDelivery done =
        evidence::deliverEvidence(folder / "session.palpa", o.records, kBriefly);
    const auto all = static_cast<std::size_t>(done.trials.added + done.trials.present);
    std::printf("In the records of %s: %s\n", done.trainee.c_str(), counted(all, "trial").c_str());
  } catch (const std::exception& e) {
    std::fprintf(stderr,
                 "palpa: not in the records yet (%s); palpa records deliver sends it later\n",
                 firstLine(e).c_str());
  }
}

}  // namespace palpa::session

#include "apps/session/session_records.h"

#include <cstdio>

#include <nlohmann/json.hpp>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "apps/evidence/evidence_records.h"
#include "apps/evidence/expert_ranges.h"
#include "apps/training/engine.h"

namespace palpa::session {
namespace {

constexpr char kNobody[] = "T000";
constexpr record::Patience kBriefly{2, 300'000'000};  // a person waits

}  // namespace

void checkTrainee(SessionOptions& o) {
  if (o.records.empty()) return;
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
    std::fprintf(stderr, "palpa: %s\n", e.what());
  }
}

namespace {

/// What a session's trials will differ in, in the words of the practice pages (`PracticeTrial`).
std::string conditionOf(const SessionOptions& o, training::Engine engine) {
  if (engine == training::Engine::search) return o.blocks ? "" : o.mode;
  if (engine == training::Engine::friction && o.sort) return "put in order";
  if (o.augment) return "cues on";
  return o.guidance ? "guided" : "";
}

}  // namespace

nlohmann::json othersLike(const SessionOptions& o, bool simulated, const std::string& task_json) {
  const nlohmann::json task = parseJson(task_json);
  const std::string id = task.value("id", "");
  const auto engine = training::engineNamed(task.value("engine", "needle"));
  nlohmann::json groups = nlohmann::json::array();
  if (const auto experts = evidence::shippedExperts(id)) groups.push_back(jsonOf(*experts));
  if (o.records.empty() || !engine || (*engine == training::Engine::search && o.blocks))
    return groups;
  try {
    record::RecordStore store(o.records);
    const std::string stored = *engine == training::Engine::needle ? id : training::nameOf(*engine);
    const std::string condition = conditionOf(o, *engine);
    evidence::PracticeChoice choice;
    choice.task = stored;
    choice.task_id = id;
    for (const progress::Series& series : progress::seriesOf(evidence::practiceIn(store, choice)))
      if (series.condition == condition && series.simulated == simulated &&
          series.force_feedback == o.force_feedback)
        if (const auto others = progress::othersIn(series, o.trainee))
          groups.push_back(jsonOf(*others));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "palpa: the report will show nobody beside (%s)\n", e.what());
  }
  return groups;
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
    const std::string what = e.what();
    std::fprintf(stderr,
                 "palpa: not in the records yet (%s); palpa records deliver sends it later\n",
                 what.substr(0, what.find('\n')).c_str());
  }
}

}  // namespace palpa::session

#include "apps/study/run/participant.h"
#include "anatomy/base/json_text.h"
#include "apps/runtime/clock.h"
#include "apps/training/engine.h"

#include <algorithm>
#include <set>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/whole_file.h"
#include "apps/evidence/evidence_records.h"
#include "apps/os/file_access.h"
#include "apps/record/session_file.h"
#include "apps/record/store/delivery.h"
#include "apps/session/output_folder.h"
#include "apps/study/protocol.h"
#include "apps/task_needle/task_file.h"
#include "calibration/expert_path.h"

namespace palpa::study {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigestLength = 12;  // digits of a digest

/// What this station knows of somebody in a study, so that a session can go on while the records
/// cannot be reached.
struct StudyCopy {
  std::string protocol_sha256;
  record::Enrolment enrolment;
  std::vector<study::DoneTrial> trials;
  /// first those that the records have, their words left out here
  std::vector<record::ItemAnswer> answers;
  std::size_t sent = 0;  ///< how many those are
};

/// Beside the list of pending sessions; one file for study, trainee and records.
fs::path studyCopyFile(const std::string& study, const std::string& trainee,
                       const std::string& url) {
  return record::PendingList::usualFolder().parent_path() / "studies" /
         (study + "-" + trainee + "-" + sha256(url).substr(0, kDigestLength) + ".json");
}

/// None where there is no file, or none that can be read: then the records are needed.
std::optional<StudyCopy> readStudyCopy(const fs::path& file) {
  const std::optional<std::string> text = readWhole(file);
  if (!text) return std::nullopt;
  try {
    const nlohmann::json json = parseJson(*text);
    StudyCopy copy;
    copy.protocol_sha256 = json.at("protocol_sha256");
    const nlohmann::json& e = json.at("enrolment");
    copy.enrolment = {e.at("study"),     e.at("trainee"),   e.at("group"),       e.at("place"),
                      e.at("condition"), e.at("simulated"), e.at("enrolled_utc")};
    for (const nlohmann::json& t : json.at("trials"))
      copy.trials.push_back(
          {t.at("step"), t.at("session"), t.at("began_utc"), t.at("ended_s"), t.at("outcome")});
    for (const nlohmann::json& a : json.at("answers"))
      copy.answers.push_back({copy.enrolment.study, copy.enrolment.trainee, a.at("session"),
                              a.at("item"), a.at("questionnaire"), a.at("answer"),
                              a.at("answered_utc")});
    copy.sent = json.at("sent");
    return copy;
  } catch (const nlohmann::json::exception&) {  // the records know better
    return std::nullopt;
  }
}

/// Beside, then renamed; throws Error.
void writeStudyCopy(const StudyCopy& copy, const fs::path& file) {
  const record::Enrolment& e = copy.enrolment;
  nlohmann::json json{{"protocol_sha256", copy.protocol_sha256},
                      {"enrolment",
                       {{"study", e.study},
                        {"trainee", e.trainee},
                        {"group", e.group},
                        {"place", e.place},
                        {"condition", e.condition},
                        {"simulated", e.simulated},
                        {"enrolled_utc", e.enrolled_utc}}},
                      {"trials", nlohmann::json::array()},
                      {"answers", nlohmann::json::array()},
                      {"sent", copy.sent}};
  for (const study::DoneTrial& t : copy.trials)
    json["trials"].push_back({{"step", t.step},
                              {"session", t.session},
                              {"began_utc", t.began_utc},
                              {"ended_s", t.ended_s},
                              {"outcome", t.outcome}});
  for (std::size_t i = 0; i < copy.answers.size(); ++i) {
    const record::ItemAnswer& a = copy.answers[i];
    json["answers"].push_back({{"session", a.session},
                               {"item", a.item},
                               {"questionnaire", a.questionnaire},
                               {"answer", i < copy.sent ? "" : a.answer},
                               {"answered_utc", a.answered_utc}});
  }
  if (const std::error_code problem = os::makeFolders(file.parent_path()))
    failFile("cannot be made", file.parent_path(), problem,
             "Or set XDG_STATE_HOME to another folder");
  writeWhole(file, json.dump(1) + "\n");
}

/// Throws UsageError for somebody who cannot take part.
void needFit(const record::Trainee& trainee, const study::Protocol& protocol, bool enrolled) {
  const std::string who = "trainee " + trainee.id;
  for (const auto& [excluded, why] : excludedFrom(protocol))
    if (excluded == trainee.id)
      throw UsageError(why, who, "Experts who calibrate take no part; enrol somebody else");
  if (trainee.research_utc.empty() && trainee.experience != kSimulatedExperience)
    throw UsageError("has not agreed to studies", who,
                     "Record the consent once it is given: palpa records trainee change --id " +
                         trainee.id + " --research");
  if (!enrolled && !protocol.group(trainee.group))
    throw UsageError(
        "is in the group \"" + trainee.group + "\", which is not one of the study's", who,
        "Correct it: palpa records trainee change --id " + trainee.id + " --group ...");
}

/// Whose session it is; empty where that cannot be read, as `palpa records deliver` says.
std::string traineeIn(const fs::path& evidence) {
  try {
    return parseJson(record::SessionReader(evidence).info().session_json).value("trainee", "");
  } catch (const std::exception&) {
    return "";
  }
}

/// Of this trainee, on this station, but what still goes on. A session that was noted but has no
/// file never began.
std::vector<record::PendingSession> waitingFor(const std::string& trainee, const std::string& url) {
  const record::PendingList pending(record::PendingList::usualFolder());
  std::vector<record::PendingSession> waiting = pending.sessions();
  std::erase_if(waiting, [&](const record::PendingSession& s) {
    return s.url != evidence::absoluteRecords(url) || pending.isHeld(s.uuid) ||
           (fs::exists(s.evidence) && traineeIn(s.evidence) != trainee);
  });
  return waiting;
}

}  // namespace

void removeStudyCopies(const std::string& trainee) {
  std::error_code ignored;
  std::vector<fs::path> theirs;
  for (const auto& entry : fs::directory_iterator(
           record::PendingList::usualFolder().parent_path() / "studies", ignored))
    if (const auto copy = readStudyCopy(entry.path()); copy && copy->enrolment.trainee == trainee)
      theirs.push_back(entry.path());
  for (const fs::path& file : theirs) fs::remove(file, ignored);
}

StudyParticipant::StudyParticipant(const study::Protocol& protocol, const std::string& trainee,
                                   const std::string& url, std::uint64_t seed)
    : protocol_(protocol),
      trainee_(trainee),
      url_(url),
      seed_(seed),
      copy_(studyCopyFile(protocol.id, trainee, url)) {
  readCopy();
  refresh();
}

void StudyParticipant::refresh() {
  try {
    sendWaiting();
    fromRecords();
    online_ = true;
    writeCopy();
  } catch (const record::StoreUnreachable&) {
    if (enrolment_.study.empty()) throw;
    online_ = false;
    addWaiting();
  }
}

/// Sessions whose program was killed, or whose records could not be reached.
void StudyParticipant::sendWaiting() {
  for (const record::PendingSession& waiting : waitingFor(trainee_, url_)) {
    if (fs::exists(waiting.evidence))
      evidence::deliverEvidence(waiting.evidence, url_);
    else
      record::PendingList(record::PendingList::usualFolder()).forget(waiting.uuid);
  }
}

void StudyParticipant::fromRecords() {
  record::RecordStore store(url_);
  record::StudyStore studies(store);
  const std::optional<record::Trainee> trainee = store.trainee(trainee_);
  if (!trainee)
    throw UsageError(
        "is not in the records", "trainee " + trainee_,
        "Add the trainee: palpa records trainee add --id " + trainee_ + " --group ... --research");
  const std::optional<record::Enrolment> there = studies.enrolment(protocol_.id, trainee_);
  needFit(*trainee, protocol_, there.has_value());
  const std::string now = runtime::utcNow();
  record::Enrolment wanted;
  wanted.study = protocol_.id;
  wanted.trainee = trainee_;
  wanted.group = there ? there->group : trainee->group;
  wanted.simulated = trainee->experience == kSimulatedExperience;
  wanted.enrolled_utc = now;
  enrolment_ = studies.enrol({protocol_.id, protocol_.sha256, seed_, now}, wanted,
                             [&](std::uint64_t seed, std::int64_t place) {
                               return protocol_.allocation
                                          ? study::conditionOf(*protocol_.allocation, wanted.group,
                                                               seed, place)
                                          : std::string();
                             });
  for (KnownAnswer& known : answers_)
    if (!known.sent) studies.answer(known.answer);
  answers_.clear();
  for (const record::ItemAnswer& answer : studies.answers(protocol_.id, trainee_))
    answers_.push_back({answer, true});
  trials_.clear();
  for (const record::TrialWithSession& t :
       store.trials({.trainee = trainee_, .study = protocol_.id}))
    trials_.push_back(study::doneTrial(t.session, t.trial));
}

/// What the records do not know yet. In the order in which it began: here one clock counts.
void StudyParticipant::addWaiting() {
  std::set<std::string> known;
  for (const study::DoneTrial& trial : trials_) known.insert(trial.session);
  std::vector<evidence::EvidenceRecords> more;
  for (const record::PendingSession& waiting : waitingFor(trainee_, url_))
    if (!known.count(waiting.uuid) && fs::exists(waiting.evidence))
      more.push_back(evidence::recordsOf(waiting.evidence));
  std::erase_if(
      more, [&](const evidence::EvidenceRecords& r) { return r.session.study != protocol_.id; });
  std::sort(more.begin(), more.end(),
            [](const evidence::EvidenceRecords& a, const evidence::EvidenceRecords& b) {
              return a.session.started_utc < b.session.started_utc;
            });
  for (const evidence::EvidenceRecords& records : more)
    for (const record::StoredTrial& trial : records.trials)
      trials_.push_back(study::doneTrial(records.session, trial));
}

study::Next StudyParticipant::next(const std::string& now_utc) const {
  std::vector<std::pair<int, std::string>> answered;
  for (const KnownAnswer& known : answers_)
    answered.emplace_back(static_cast<int>(known.answer.session), known.answer.item);
  return study::nextOf(protocol_, enrolment_.condition, trials_, answered, now_utc);
}

void StudyParticipant::answer(int session, const std::string& item, const std::string& text) {
  const std::string& questionnaire =
      protocol_.sessions[static_cast<std::size_t>(session - 1)].questionnaire->id;
  answers_.push_back(
      {{protocol_.id, trainee_, session, item, questionnaire, text, runtime::utcNow()}, false});
  writeCopy();
  if (!online_) return;
  try {
    record::RecordStore store(url_);
    record::StudyStore(store).answer(answers_.back().answer);
    answers_.back().sent = true;
  } catch (const record::StoreUnreachable&) {
    online_ = false;
  }
  writeCopy();
}

void StudyParticipant::readCopy() {
  const std::optional<StudyCopy> copy = readStudyCopy(copy_);
  if (!copy || copy->protocol_sha256 != protocol_.sha256) return;
  enrolment_ = copy->enrolment;
  trials_ = copy->trials;
  for (std::size_t i = 0; i < copy->answers.size(); ++i)
    answers_.push_back({copy->answers[i], i < copy->sent});
}

void StudyParticipant::writeCopy() const {
  StudyCopy copy{protocol_.sha256, enrolment_, trials_, {}, 0};
  for (const bool sent : {true, false})
    for (const KnownAnswer& known : answers_)
      if (known.sent == sent) {
        copy.answers.push_back(known.answer);
        copy.sent += sent;
      }
  writeStudyCopy(copy, copy_);
}

namespace {

void addExpertsOf(const study::Block& block,
                  std::vector<std::pair<std::string, std::string>>* excluded) {
  if (block.engine != training::Engine::needle) return;
  const task_needle::TaskSettings task = task_needle::readTask(block.task);
  if (task.expert_path.empty()) return;
  for (const std::string& expert : calibration::readExpertPath(task.expert_path).experts)
    excluded->emplace_back(expert, "made the expert path that this study is judged by (" +
                                       task.expert_path.string() + ")");
}

}  // namespace

std::vector<std::pair<std::string, std::string>> excludedFrom(const study::Protocol& protocol) {
  std::vector<std::pair<std::string, std::string>> excluded;
  for (const std::string& trainee : protocol.excluded)
    excluded.emplace_back(trainee, "is excluded by the protocol");
  if (!protocol.excludes_experts) return excluded;
  for (const study::Session& session : protocol.sessions)
    for (const study::Block& block : session.blocks) addExpertsOf(block, &excluded);
  return excluded;
}

void addSimulated(record::RecordStore& store, const std::string& id, const std::string& group,
                  const std::string& now_utc) {
  if (const auto there = store.trainee(id)) {
    if (there->experience != kSimulatedExperience)
      throw UsageError("is somebody in the records", "trainee " + id,
                       "Give virtual trainees records of their own: --records cohort.sqlite");
    return;
  }
  store.addTrainee({id, group, kSimulatedExperience, "right", now_utc, "", "", ""});
}

}  // namespace palpa::study

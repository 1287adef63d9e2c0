#include "apps/record/store/record_store.h"

#include <cctype>
#include <cstdio>
#include <limits>

#include "anatomy/base/counted.h"
#include "anatomy/base/sha256.h"
#include "apps/record/store/migrations.h"
#include "apps/record/store/record_reading.h"

namespace palpa::record {
namespace {

Trainee traineeOf(const SqlRows& r, std::size_t i) {
  return {r.text(i, 0), r.text(i, 1), r.text(i, 2), r.text(i, 3),
          r.text(i, 4), r.text(i, 5), r.text(i, 6), r.text(i, 7)};
}

std::vector<Trainee> traineesOf(const SqlRows& rows) {
  std::vector<Trainee> all;
  for (std::size_t i = 0; i < rows.size(); ++i) all.push_back(traineeOf(rows, i));
  return all;
}

std::vector<SqlValue> valuesOf(const Trainee& t) {
  return {t.id,        t.group,       t.experience,   t.handedness,
          t.added_utc, t.consent_utc, t.research_utc, t.retain_until};
}

void require(const Trainee& trainee) {
  if (const std::string why = whyNoPseudonym(trainee.id); !why.empty())
    throw UsageError(why, "trainee \"" + trainee.id + "\"", "Choose another pseudonym");
  if (trainee.handedness != "right" && trainee.handedness != "left")
    throw UsageError("must be right or left", "handedness of " + trainee.id, "Give one of them");
}

}  // namespace

double StoredTrial::metric(const std::string& name) const {
  for (const Metric& m : metrics)
    if (m.name == name) return m.value;
  return std::numeric_limits<double>::quiet_NaN();
}

std::string whyNoPseudonym(const std::string& id) {
  const bool fits =
      !id.empty() && id[0] != '-' && id[0] != '_' && id.size() <= 32 &&
      id.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_") ==
          std::string::npos;
  return fits ? ""
              : "a pseudonym has 1 to 32 letters, digits, - or _, and begins with a letter or a "
                "digit";
}

bool mentions(std::string_view text, const std::string& id, bool strictly) {
  const auto joins = [&](std::size_t at) {
    const auto c = static_cast<unsigned char>(at < text.size() ? text[at] : ' ');
    return std::isalnum(c) || (strictly && (c == '-' || c == '_'));
  };
  for (std::size_t at = text.find(id); at != std::string_view::npos; at = text.find(id, at + 1))
    if ((at == 0 || !joins(at - 1)) && !joins(at + id.size())) return true;
  return false;
}

RecordStore::RecordStore(std::unique_ptr<SqlConnection> connection)
    : connection_(std::move(connection)), deletions_(*connection_, "") {
  migrate(*connection_);
}

RecordStore::RecordStore(const std::string& url)
    : connection_(connect(url)), deletions_(*connection_, url) {
  migrate(*connection_);
  const DeletedAgain again = deletions_.obey();
  if (again.people + again.sessions == 0) return;
  std::fprintf(
      stderr, "Deleted again from the %s, into which a backup had brought them: %s, %s%s\n",
      place().c_str(), counted(static_cast<std::size_t>(again.people), "deleted trainee").c_str(),
      counted(static_cast<std::size_t>(again.sessions), "session").c_str(),
      evidenceToDelete().empty() ? "" : "; their evidence: palpa records delete --left");
}

void RecordStore::addTrainee(const Trainee& trainee) {
  require(trainee);
  SqlTransaction transaction(*connection_);
  const SqlRows added = connection_->query(
      "INSERT INTO trainees(" + columnsOf("trainees") +
          ") VALUES($1,$2,$3,$4,$5,$6,$7,$8) ON CONFLICT(id) DO NOTHING RETURNING id",
      valuesOf(trainee));
  if (added.empty())
    throw UsageError("is in the records already", "trainee " + trainee.id,
                     "Choose another pseudonym, or change this one: palpa records trainee change");
  transaction.commit();
}

void RecordStore::changeTrainee(const Trainee& trainee) {
  require(trainee);
  SqlTransaction transaction(*connection_);
  const SqlRows changed = connection_->query(
      "UPDATE trainees SET "
      "group_name=$2,experience=$3,handedness=$4,added_utc=$5,consent_utc=$6,research_utc=$7,"
      "retain_until=$8 WHERE id=$1 RETURNING id",
      valuesOf(trainee));
  if (changed.empty())
    throw UsageError("is not in the records", "trainee " + trainee.id,
                     "Add it: palpa records trainee add");
  transaction.commit();
}

std::optional<Trainee> RecordStore::trainee(const std::string& id) {
  const SqlRows rows =
      connection_->query("SELECT " + columnsOf("trainees") + " FROM trainees WHERE id=$1", {id});
  return rows.empty() ? std::nullopt : std::optional(traineeOf(rows, 0));
}

std::vector<Trainee> RecordStore::trainees() {
  return traineesOf(
      connection_->query("SELECT " + columnsOf("trainees") + " FROM trainees ORDER BY id"));
}

bool RecordStore::wasDeleted(const std::string& digest) {
  return !deletions_.lastDeletion(digest).empty();
}

std::vector<Trainee> RecordStore::overdue(const std::string& date) {
  return traineesOf(connection_->query(
      "SELECT " + columnsOf("trainees") +
          " FROM trainees WHERE retain_until<>'' AND retain_until<$1 ORDER BY id",
      {date}));
}

/// A pseudonym that was given anew brings nothing back from before its deletion.
void RecordStore::requireNotDeleted(const StoredSession& s) {
  if (!deletions_.isDeleted(s.uuid)) {
    const std::string last = deletions_.lastDeletion(sha256(s.trainee));
    if (last.empty() || last < s.started_utc) return;
  }
  throw PersonDeleted("was deleted on request after this session had begun; the trial is refused",
                      "trainee " + s.trainee, "Remove its evidence, too: " + s.evidence);
}

/// The trainee's row is locked by the update, so two stations number his sessions one after the
/// other.
void RecordStore::requireSession(const StoredSession& s) {
  if (connection_->query("UPDATE trainees SET id=id WHERE id=$1 RETURNING id", {s.trainee})
          .empty()) {
    if (wasDeleted(sha256(s.trainee)))
      throw PersonDeleted("was deleted on request; the trial is refused", "trainee " + s.trainee,
                          "Remove its evidence, too: " + s.evidence);
    throw UsageError("is not in the records", "trainee " + s.trainee,
                     "Add it: palpa records trainee add --id " + s.trainee);
  }
  const SqlRows owner = connection_->query("SELECT trainee FROM sessions WHERE uuid=$1", {s.uuid});
  if (owner.empty()) {
    requireNotDeleted(s);
    insertSession(s);
  } else if (owner.text(0, 0) != s.trainee)
    throw UsageError("belongs to another trainee", "session " + s.uuid,
                     "Two people cannot share a session; give each of them one");
}

void RecordStore::insertSession(const StoredSession& s) {
  const std::int64_t arrival =
      1 + connection_
              ->query("SELECT COALESCE(MAX(arrival),0) FROM sessions WHERE trainee=$1", {s.trainee})
              .integer(0, 0);
  connection_->query(
      "INSERT INTO sessions(" + columnsOf("sessions") +
          ") VALUES($1,$2,$3,$4,$5,$6,$7,$8,$9,$10,$11,$12,$13)",
      {s.uuid, s.trainee, arrival, s.started_utc, s.software, s.task, s.station,
       std::int64_t{s.simulated}, s.study, s.slot, s.evidence, s.evidence_sha256, s.facts_json});
  for (const StoredCalibration& c : s.calibrations)
    connection_->query("INSERT INTO calibrations(" + columnsOf("calibrations") +
                           ") VALUES($1,$2,$3,$4,$5) ON CONFLICT(session,name) DO NOTHING",
                       {s.uuid, c.name, c.made_utc, c.sha256, c.verdict});
}

bool RecordStore::addTrial(const StoredSession& session, const StoredTrial& trial) {
  return addTrials(session, {trial}) > 0;
}

int RecordStore::addTrials(const StoredSession& session, const std::vector<StoredTrial>& trials) {
  SqlTransaction transaction(*connection_);
  requireSession(session);
  int added = 0;
  std::string kept;  // the set of metrics of the trial before
  for (const StoredTrial& trial : trials) added += insertTrial(session.uuid, trial, kept) ? 1 : 0;
  transaction.commit();
  return added;
}

bool RecordStore::insertTrial(const std::string& session, const StoredTrial& t, std::string& kept) {
  const PackedMetrics metrics = packed(t.metrics);
  if (metrics.set != kept) keepSet(*connection_, metrics);
  kept = metrics.set;
  const SqlRows added = connection_->query(
      "INSERT INTO trials(" + columnsOf("trials") +
          ") VALUES($1,$2,$3,$4,$5,$6,$7,$8,$9,$10,$11,$12,$13) ON CONFLICT(session,number) DO "
          "NOTHING RETURNING number",
      {session, t.number, t.start_ns, t.end_ns, t.role, std::to_string(t.seed),
       std::int64_t{t.force_feedback}, t.outcome, t.reason, std::int64_t{t.success}, t.score_json,
       metrics.set, metrics.values});
  if (added.empty()) return false;
  std::vector<std::vector<SqlValue>> events;
  for (const StoredEvent& e : t.events)
    events.push_back({session, t.number, static_cast<std::int64_t>(events.size() + 1), e.t_ns,
                      e.kind, e.text, e.value});
  insertRows(*connection_, "events", columnsOf("events"), events);
  return true;
}

std::vector<StoredSession> RecordStore::sessions(const std::string& trainee) {
  SqlTransaction moment(*connection_, Access::read);
  return sessionsOf(trainee);
}

/// Within a transaction.
std::vector<StoredSession> RecordStore::sessionsOf(const std::string& trainee) {
  std::vector<StoredSession> all;
  record::eachSession(*connection_, {.trainee = trainee},
                      [&](const StoredSession& session) { all.push_back(session); });
  return all;
}

std::optional<StoredSession> RecordStore::session(const std::string& uuid) {
  if (uuid.empty()) return std::nullopt;  // a filter without one is for all
  SqlTransaction moment(*connection_, Access::read);
  std::optional<StoredSession> found;
  record::eachSession(*connection_, {.session = uuid},
                      [&](const StoredSession& session) { found = session; });
  return found;
}

void RecordStore::eachTrial(const TrialFilter& filter,
                            const std::function<void(const TrialWithSession&)>& visit) {
  SqlTransaction moment(*connection_, Access::read);
  record::eachTrial(*connection_, filter, visit);
}

std::vector<TrialWithSession> RecordStore::trials(const TrialFilter& filter) {
  std::vector<TrialWithSession> all;
  eachTrial(filter, [&](const TrialWithSession& trial) { all.push_back(trial); });
  return all;
}

std::vector<Tally> RecordStore::tallies(const std::string& trainee) {
  return record::tallies(*connection_, trainee);
}

std::vector<StoredEvent> RecordStore::events(const std::string& session, std::int64_t number) {
  const SqlRows rows = connection_->query(
      "SELECT t_ns,kind,text,value FROM events WHERE session=$1 AND number=$2 ORDER BY ordinal",
      {session, number});
  std::vector<StoredEvent> all;
  for (std::size_t i = 0; i < rows.size(); ++i)
    all.push_back({rows.integer(i, 0), rows.text(i, 1), rows.text(i, 2), rows.real(i, 3)});
  return all;
}

std::vector<StoredSession> RecordStore::deletePerson(const std::string& id,
                                                     const std::string& now_utc) {
  SqlTransaction transaction(*connection_);
  if (connection_->query("UPDATE trainees SET id=id WHERE id=$1 RETURNING id", {id}).empty())
    throw UsageError("is not in the records", "trainee " + id,
                     "palpa records trainee list shows who is in them");
  std::vector<StoredSession> theirs = sessionsOf(id);
  std::vector<std::string> uuids;
  for (const StoredSession& s : theirs) {
    deleteSessionRows(*connection_, s.uuid, false);
    uuids.push_back(s.uuid);
  }
  connection_->query("DELETE FROM trainees WHERE id=$1", {id});
  deletions_.note(id, now_utc, uuids);
  transaction.commit();
  settleDeletions();
  return theirs;
}

std::vector<std::string> RecordStore::settleDeletions() {
  std::vector<std::string> troubles = deletions_.keepLists();
  for (std::string& trouble : troubles)
    trouble += "; until then a backup that is restored may bring back who was deleted";
  const std::string remains = place() + ": bytes of what was deleted may remain in it (",
                    later = "). Run later: palpa records delete --left";
  try {
    if (!connection_->leaveNoTrace()) troubles.push_back(remains + "others read it now" + later);
  } catch (const Error& e) {
    troubles.push_back(remains + e.what() + later);
  }
  return troubles;
}

std::vector<StoredSession> RecordStore::evidenceToDelete() {
  const SqlRows rows =
      connection_->query("SELECT session,evidence FROM deleted_evidence ORDER BY session");
  std::vector<StoredSession> all(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    all[i].uuid = rows.text(i, 0);
    all[i].evidence = rows.text(i, 1);
  }
  return all;
}

void RecordStore::evidenceDeleted(const std::string& session) {
  SqlTransaction transaction(*connection_);
  deletions_.noteRemoved(session);
  // also of a deletion by an older version, which knew no list
  connection_->query("DELETE FROM deleted_evidence WHERE session=$1", {session});
  transaction.commit();
}

}  // namespace palpa::record

#include "apps/record/store/record_store.h"

#include <cctype>
#include <charconv>
#include <cstdio>
#include <limits>

#include "anatomy/base/counted.h"
#include "anatomy/base/sha256.h"
#include "apps/record/store/migrations.h"

namespace palpa::record {
namespace {

constexpr std::size_t kSessionColumnCount = 13;

Trainee traineeOf(const SqlRows& r, std::size_t i) {
  return {r.text(i, 0), r.text(i, 1), r.text(i, 2), r.text(i, 3),
          r.text(i, 4), r.text(i, 5), r.text(i, 6), r.text(i, 7)};
}

StoredSession sessionOf(const SqlRows& r, std::size_t i) {
  return {r.text(i, 0),    r.text(i, 1),
          r.integer(i, 2), r.text(i, 3),
          r.text(i, 4),    r.text(i, 5),
          r.text(i, 6),    r.integer(i, 7) != 0,
          r.text(i, 8),    r.integer(i, 9),
          r.text(i, 10),   r.text(i, 11),
          r.text(i, 12),   {}};
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

std::uint64_t seedOf(const std::string& digits, const SqlConnection& store) {
  std::uint64_t seed = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), seed);
  if (problem != std::errc() || end != digits.data() + digits.size())
    throw Error("is damaged (a seed is not a number)", store.place(),
                "Restore a backup: palpa records restore");
  return seed;
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

bool RecordStore::addTrial(const StoredSession& session, const StoredTrial& t) {
  SqlTransaction transaction(*connection_);
  requireSession(session);
  const SqlRows added = connection_->query(
      "INSERT INTO "
      "trials(session,number,start_ns,end_ns,role,seed,force_feedback,outcome,reason,success,score_"
      "json) VALUES($1,$2,$3,$4,$5,$6,$7,$8,$9,$10,$11) ON CONFLICT(session,number) DO NOTHING "
      "RETURNING number",
      {session.uuid, t.number, t.start_ns, t.end_ns, t.role, std::to_string(t.seed),
       std::int64_t{t.force_feedback}, t.outcome, t.reason, std::int64_t{t.success}, t.score_json});
  if (added.empty()) {
    transaction.commit();
    return false;
  }
  for (const Metric& m : t.metrics)
    connection_->query("INSERT INTO metrics(session,number,name,value) VALUES($1,$2,$3,$4)",
                       {session.uuid, t.number, m.name, m.value});
  std::int64_t ordinal = 0;
  for (const StoredEvent& e : t.events)
    connection_->query(
        "INSERT INTO events(session,number,ordinal,t_ns,kind,text,value) "
        "VALUES($1,$2,$3,$4,$5,$6,$7)",
        {session.uuid, t.number, ++ordinal, e.t_ns, e.kind, e.text, e.value});
  transaction.commit();
  return true;
}

std::vector<StoredSession> RecordStore::sessions(const std::string& trainee) {
  const SqlRows rows =
      connection_->query("SELECT " + columnsOf("sessions") +
                             " FROM sessions WHERE $1='' OR trainee=$1 ORDER BY trainee,arrival",
                         {trainee});
  std::vector<StoredSession> all;
  for (std::size_t i = 0; i < rows.size(); ++i) all.push_back(sessionOf(rows, i));
  return all;
}

std::optional<StoredSession> RecordStore::session(const std::string& uuid) {
  const SqlRows rows = connection_->query(
      "SELECT " + columnsOf("sessions") + " FROM sessions WHERE uuid=$1", {uuid});
  if (rows.empty()) return std::nullopt;
  StoredSession session = sessionOf(rows, 0);
  const SqlRows calibrations = connection_->query(
      "SELECT name,made_utc,sha256,verdict FROM calibrations WHERE session=$1 ORDER BY name",
      {uuid});
  for (std::size_t i = 0; i < calibrations.size(); ++i)
    session.calibrations.push_back({calibrations.text(i, 0), calibrations.text(i, 1),
                                    calibrations.text(i, 2), calibrations.text(i, 3)});
  return session;
}

std::vector<TrialWithSession> RecordStore::trials(const TrialFilter& f) {
  const std::string where =
      " WHERE ($1='' OR s.trainee=$1) AND ($2='' OR s.task=$2) AND ($3='' OR s.study=$3) AND "
      "($4='' OR s.uuid=$4) AND ($5=-1 OR s.simulated=$5)";
  const std::vector<SqlValue> values{f.trainee, f.task, f.study, f.session,
                                     std::int64_t{f.simulated}};
  SqlTransaction moment(*connection_);  // trials and their metrics must match
  connection_->freeze();
  const SqlRows rows = connection_->query(
      "SELECT "
      "s.uuid,s.trainee,s.arrival,s.started_utc,s.software,s.task,s.station,s.simulated,s.study,s."
      "slot,s.evidence,s.evidence_sha256,s.facts_json,"
      "t.number,t.start_ns,t.end_ns,t.role,t.seed,t.force_feedback,t.outcome,t.reason,t.success,t."
      "score_json FROM sessions s JOIN trials t ON t.session=s.uuid" +
          where + " ORDER BY s.trainee,s.arrival,t.number",
      values);
  const SqlRows metrics = connection_->query(
      "SELECT m.session,m.number,m.name,m.value FROM sessions s JOIN metrics m ON "
      "m.session=s.uuid" +
          where + " ORDER BY s.trainee,s.arrival,m.number,m.name",
      values);
  std::vector<TrialWithSession> all;
  std::size_t m = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    constexpr std::size_t c = kSessionColumnCount;
    TrialWithSession entry{sessionOf(rows, i),
                           {rows.integer(i, c),
                            rows.integer(i, c + 1),
                            rows.integer(i, c + 2),
                            rows.text(i, c + 3),
                            seedOf(rows.text(i, c + 4), *connection_),
                            rows.integer(i, c + 5) != 0,
                            rows.text(i, c + 6),
                            rows.text(i, c + 7),
                            rows.integer(i, c + 8) != 0,
                            rows.text(i, c + 9),
                            {},
                            {}}};
    for (; m < metrics.size() && metrics.text(m, 0) == entry.session.uuid &&
           metrics.integer(m, 1) == entry.trial.number;
         ++m)
      entry.trial.metrics.push_back({metrics.text(m, 2), metrics.real(m, 3)});
    all.push_back(std::move(entry));
  }
  return all;
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
  std::vector<StoredSession> theirs = sessions(id);
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

#include "apps/record/store/deletions.h"

#include <algorithm>

#include "anatomy/base/error.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/uuid.h"
#include "apps/os/file_access.h"

namespace palpa::record {
namespace {

namespace fs = std::filesystem;

/// About 10 ms for one pseudonym.
constexpr int kDigestRounds = 30'000;

/// Of all records of this user; empty where there is no home.
fs::path stateLists() {
  try {
    return os::stateFolder("") / "palpa/deletions";
  } catch (const UsageError&) {
    return {};
  }
}

fs::path listBeside(const std::string& url) {
  return fs::absolute(url).string() + ".deletions.json";
}

/// Evidence, which may have come back with a backup as well.
bool isHere(const std::string& evidence) {
  std::error_code none;
  return fs::exists(evidence, none);
}

bool holds(const std::vector<DeletedPerson>& all, const DeletedPerson& one) {
  return std::any_of(all.begin(), all.end(), [&](const DeletedPerson& p) {
    return p.digest == one.digest && p.deleted_utc == one.deleted_utc;
  });
}

/// Adds what `more` names and `list` does not. False: nothing was new.
bool join(DeletionList& list, const DeletionList& more) {
  bool grew = false;
  for (const DeletedPerson& person : more.people)
    if (!holds(list.people, person)) {
      list.people.push_back(person);
      grew = true;
    }
  for (const DeletedSession& session : more.sessions) {
    const auto there =
        std::find_if(list.sessions.begin(), list.sessions.end(),
                     [&](const DeletedSession& s) { return s.uuid == session.uuid; });
    if (there == list.sessions.end())
      list.sessions.push_back(session);
    else if (session.removed && !there->removed)
      there->removed = true;
    else
      continue;
    grew = true;
  }
  return grew;
}

bool sharesASession(SqlConnection& store, const DeletionList& list) {
  return std::any_of(
      list.sessions.begin(), list.sessions.end(), [&](const DeletedSession& session) {
        return !store.query("SELECT 1 FROM sessions WHERE uuid=$1", {session.uuid}).empty();
      });
}

}  // namespace

bool deleteSessionRows(SqlConnection& connection, const std::string& session,
                       bool evidence_removed) {
  const SqlRows row = connection.query("SELECT evidence FROM sessions WHERE uuid=$1", {session});
  if (row.empty()) return false;
  if (!evidence_removed || isHere(row.text(0, 0)))
    connection.query(
        "INSERT INTO deleted_evidence(session,evidence) VALUES($1,$2) ON CONFLICT(session) DO "
        "NOTHING",
        {session, row.text(0, 0)});
  // trials, metrics, events, calibrations go with it
  connection.query("DELETE FROM sessions WHERE uuid=$1", {session});
  return true;
}

/// Of records that have no name yet: a backup from before there were names. Its list lies beside
/// it, or is the one with which it shares a session.
DeletionList Deletions::adopted() {
  if (url_.empty()) return {};
  if (!isServer(url_))
    if (auto beside = readDeletions(listBeside(url_))) return *beside;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(stateLists(), none))
    if (auto list = readDeletions(entry.path()); list && sharesASession(connection_, *list))
      return *list;
  return {};
}

/// Name and salt; made where there are none. Several stations may be at it.
DeletionList Deletions::identity() {
  const auto read = [&] { return connection_.query("SELECT records,salt FROM records_identity"); };
  SqlRows row = read();
  if (row.empty()) {
    DeletionList made = adopted();
    if (made.records.empty()) made = {newUuid(), newUuid() + newUuid(), {}, {}};
    connection_.query(
        "INSERT INTO records_identity(one,records,salt) VALUES(1,$1,$2) ON CONFLICT(one) DO "
        "NOTHING",
        {made.records, made.salt});
    row = read();
  }
  return {row.text(0, 0), row.text(0, 1), {}, {}};
}

std::string Deletions::digestOf(const std::string& sha256) {
  return slowSha256(sha256, identity().salt, kDigestRounds);
}

DeletionList Deletions::inTables() {
  DeletionList list = identity();
  const SqlRows people = connection_.query(
                    "SELECT digest,deleted_utc FROM deleted_people ORDER BY deleted_utc,digest"),
                sessions = connection_.query(
                    "SELECT session,deleted_utc,removed FROM deleted_sessions ORDER BY "
                    "deleted_utc,session");
  for (std::size_t i = 0; i < people.size(); ++i)
    list.people.push_back({people.text(i, 0), people.text(i, 1)});
  for (std::size_t i = 0; i < sessions.size(); ++i)
    list.sessions.push_back(
        {sessions.text(i, 0), sessions.text(i, 1), sessions.integer(i, 2) != 0});
  return list;
}

std::vector<fs::path> Deletions::listFiles() {
  std::vector<fs::path> files;
  if (url_.empty()) return files;
  if (!isServer(url_)) files.push_back(listBeside(url_));
  if (const fs::path folder = stateLists(); !folder.empty())
    files.push_back(folder / (identity().records + ".json"));
  return files;
}

/// Older tables kept a digest that could be found by trying: it becomes what is digested.
void Deletions::moveOldRows() {
  if (connection_.query("SELECT 1 FROM deletions LIMIT 1").empty()) return;
  SqlTransaction transaction(connection_);
  const SqlRows old = connection_.query("DELETE FROM deletions RETURNING digest,deleted_utc");
  for (std::size_t i = 0; i < old.size(); ++i)
    connection_.query(
        "INSERT INTO deleted_people(digest,deleted_utc) VALUES($1,$2) ON CONFLICT DO NOTHING",
        {digestOf(old.text(i, 0)), old.text(i, 1)});
  transaction.commit();
}

/// What the lists name and `known` does not; another store's list may lie at this one's place.
DeletionList Deletions::missing(const DeletionList& known) {
  DeletionList named = known, missing{known.records, known.salt, {}, {}};
  for (const fs::path& file : listFiles())
    if (const auto list = readDeletions(file); list && list->records == known.records)
      join(named, *list);
  for (const DeletedPerson& person : named.people)
    if (!holds(known.people, person)) missing.people.push_back(person);
  for (const DeletedSession& session : named.sessions)
    if (std::none_of(known.sessions.begin(), known.sessions.end(), [&](const DeletedSession& s) {
          return s.uuid == session.uuid && s.removed == session.removed;
        }))
      missing.sessions.push_back(session);
  return missing;
}

/// Those of a person that began no later than `until`. True: none is left.
bool Deletions::deleteSessions(const std::string& trainee, const std::string& until,
                               DeletedAgain* again) {
  const SqlRows theirs =
      connection_.query("SELECT uuid,started_utc FROM sessions WHERE trainee=$1", {trainee});
  std::size_t gone = 0;
  for (std::size_t i = 0; i < theirs.size(); ++i)
    if (theirs.text(i, 1) <= until)
      gone += deleteSessionRows(connection_, theirs.text(i, 0), false) ? 1 : 0;
  again->sessions += static_cast<int>(gone);
  return gone == theirs.size();
}

DeletedAgain Deletions::deleteAgain(const DeletionList& missing) {
  DeletedAgain again;
  for (const DeletedSession& session : missing.sessions)
    again.sessions += deleteSessionRows(connection_, session.uuid, session.removed) ? 1 : 0;
  std::string last;
  for (const DeletedPerson& person : missing.people) last = std::max(last, person.deleted_utc);
  const SqlRows old =
      connection_.query("SELECT id,added_utc FROM trainees WHERE added_utc<=$1", {last});
  for (std::size_t i = 0; i < old.size(); ++i) {
    const std::string id = old.text(i, 0), added_utc = old.text(i, 1),
                      digest = digestOf(sha256(id));
    std::string until;
    for (const DeletedPerson& person : missing.people)
      if (person.digest == digest) until = std::max(until, person.deleted_utc);
    if (until.empty() || until < added_utc || !deleteSessions(id, until, &again)) continue;
    connection_.query("DELETE FROM trainees WHERE id=$1", {id});
    ++again.people;
  }
  return again;
}

void Deletions::insert(const DeletionList& list) {
  for (const DeletedPerson& person : list.people)
    connection_.query(
        "INSERT INTO deleted_people(digest,deleted_utc) VALUES($1,$2) ON CONFLICT DO NOTHING",
        {person.digest, person.deleted_utc});
  for (const DeletedSession& session : list.sessions) {
    connection_.query(
        "INSERT INTO deleted_sessions(session,deleted_utc,removed) VALUES($1,$2,0) ON "
        "CONFLICT(session) DO NOTHING",
        {session.uuid, session.deleted_utc});
    if (!session.removed) continue;
    const SqlRows left =
        connection_.query("SELECT evidence FROM deleted_evidence WHERE session=$1", {session.uuid});
    if (left.empty() || !isHere(left.text(0, 0)))
      noteRemoved(session.uuid);
    else
      connection_.query("UPDATE deleted_sessions SET removed=1 WHERE session=$1", {session.uuid});
  }
}

DeletedAgain Deletions::obey() {
  moveOldRows();
  const DeletionList known = inTables();
  const DeletionList news = missing(known);
  DeletedAgain again;
  if (!news.people.empty() || !news.sessions.empty()) {
    SqlTransaction transaction(connection_);
    again = deleteAgain(news);
    insert(news);
    transaction.commit();
    if (again.people + again.sessions > 0) connection_.leaveNoTrace();
  }
  keepLists();
  return again;
}

void Deletions::note(const std::string& pseudonym, const std::string& now_utc,
                     const std::vector<std::string>& sessions) {
  DeletionList list = identity();
  list.people.push_back({digestOf(sha256(pseudonym)), now_utc});
  for (const std::string& uuid : sessions) list.sessions.push_back({uuid, now_utc});
  insert(list);
}

void Deletions::noteRemoved(const std::string& session) {
  connection_.query("UPDATE deleted_sessions SET removed=1 WHERE session=$1", {session});
  connection_.query("DELETE FROM deleted_evidence WHERE session=$1", {session});
}

std::vector<std::string> Deletions::keepLists() {
  std::vector<std::string> troubles;
  const DeletionList known = inTables();
  if (known.people.empty() && known.sessions.empty()) return troubles;
  for (const fs::path& file : listFiles()) try {
      const auto there = readDeletions(file);
      if (there && there->records != known.records) continue;
      DeletionList list = there.value_or(DeletionList{known.records, known.salt, {}, {}});
      if (join(list, known)) writeDeletions(list, file);
    } catch (const Error& e) {
      troubles.emplace_back(e.what());
    }
  return troubles;
}

bool Deletions::isDeleted(const std::string& session) {
  return !connection_.query("SELECT 1 FROM deleted_sessions WHERE session=$1", {session}).empty();
}

std::string Deletions::lastDeletion(const std::string& sha256) {
  if (connection_.query("SELECT 1 FROM deleted_people LIMIT 1").empty()) return "";
  return connection_
      .query("SELECT COALESCE(MAX(deleted_utc),'') FROM deleted_people WHERE digest=$1",
             {digestOf(sha256)})
      .text(0, 0);
}

}  // namespace palpa::record

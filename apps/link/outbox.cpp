#include "apps/link/outbox.h"

#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"

namespace palpa::link {
namespace {

namespace fs = std::filesystem;

// state: 0 waits, 1 delivered, 2 taken back
constexpr char kTables[] = R"sql(
CREATE TABLE IF NOT EXISTS letters(
  number   INTEGER PRIMARY KEY AUTOINCREMENT,
  endpoint TEXT NOT NULL,
  records  TEXT NOT NULL,
  id       TEXT NOT NULL,
  voids    TEXT NOT NULL,
  session  TEXT NOT NULL,
  trial    INTEGER NOT NULL,
  person   TEXT NOT NULL,
  body     TEXT NOT NULL,
  state    INTEGER NOT NULL,
  UNIQUE(endpoint, id)
))sql";
constexpr char kColumns[] = "id,voids,session,trial,person,body";

fs::path prepared(const fs::path& file) {
  constexpr char kInstead[] = "Or set XDG_STATE_HOME to another folder";
  if (const std::error_code problem = os::makeFolders(file.parent_path()))
    failFile("cannot be made", file.parent_path(), problem, kInstead);
  if (const std::error_code problem = os::createPrivate(file))
    failFile("cannot be written", file, problem, kInstead);
  return file;
}

std::vector<Letter> lettersOf(record::Statement& statement) {
  std::vector<Letter> all;
  while (statement.step())
    all.push_back({statement.text(0), statement.text(1), statement.text(2), statement.integer(3),
                   statement.text(4), statement.text(5)});
  return all;
}

}  // namespace

Outbox::Outbox(const fs::path& file) : database_(prepared(file), record::Database::Mode::write) {
  database_.exec("PRAGMA busy_timeout=20000; PRAGMA secure_delete=ON");
  writeAhead();
  database_.exec(kTables);
}

/// One write to the disk less a statement. A power cut may take back what was noted last: it is
/// told again, and stored once.
void Outbox::writeAhead() {
  try {
    if (database_.text("PRAGMA journal_mode=WAL") == "wal")
      database_.exec("PRAGMA synchronous=NORMAL");
    // Another program is at it, or the disk does not bear it: slower
  } catch (const record::DatabaseError&) {
  }
}

fs::path Outbox::usualFile() {
  return os::stateFolder("Set HOME, or XDG_STATE_HOME to a folder of yours") / "palpa/xapi.sqlite";
}

void Outbox::insert(const Route& r, const Letter& l) {
  record::Statement(database_, std::string("INSERT OR IGNORE INTO letters(endpoint,records,") +
                                   kColumns + ",state) VALUES(?,?,?,?,?,?,?,?,0)")
      .bind(r.endpoint, r.records, l.id, l.voids, l.session, l.trial, l.person, l.body)
      .run();
}

bool Outbox::put(const Route& route, const Letter& letter) {
  record::Transaction transaction(database_);
  insert(route, letter);
  const bool is_new = database_.integer("SELECT changes()") > 0;
  transaction.commit();
  return is_new;
}

std::vector<Letter> Outbox::waiting(const std::string& endpoint) {
  record::Statement statement(database_,
                              std::string("SELECT ") + kColumns +
                                  " FROM letters WHERE endpoint=? AND state=0 ORDER BY number");
  return lettersOf(statement.bind(endpoint));
}

void Outbox::delivered(const std::string& endpoint, const std::string& id) {
  record::Statement(database_,
                    "UPDATE letters SET state=1,body='' WHERE endpoint=? AND id=? AND state=0")
      .bind(endpoint, id)
      .run();
}

std::vector<std::string> Outbox::endpoints(const std::string& records) {
  record::Statement statement(
      database_, "SELECT DISTINCT endpoint FROM letters WHERE records=? ORDER BY endpoint");
  statement.bind(records);
  std::vector<std::string> all;
  while (statement.step()) all.push_back(statement.text(0));
  return all;
}

std::vector<Letter> Outbox::sent(const Route& route) {
  record::Statement statement(
      database_,
      std::string("SELECT ") + kColumns +
          " FROM letters WHERE endpoint=? AND records=? AND voids='' AND state<2 ORDER BY number");
  return lettersOf(statement.bind(route.endpoint, route.records));
}

void Outbox::takeBack(const Route& route, const std::string& id, const Letter& voiding) {
  record::Transaction transaction(database_);
  record::Statement(database_,
                    "UPDATE letters SET state=2,body='',person='' WHERE endpoint=? AND id=?")
      .bind(route.endpoint, id)
      .run();
  insert(route, voiding);
  transaction.commit();
}

void Outbox::leaveNoTrace() {
  try {
    database_.exec("VACUUM");
    database_.integer("PRAGMA wal_checkpoint(TRUNCATE)");
  } catch (const record::DatabaseError&) {  // another program is at it: it is done the next time
  }
}

}  // namespace palpa::link

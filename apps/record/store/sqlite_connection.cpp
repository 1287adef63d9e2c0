#include <sqlite3.h>

#include <cstring>
#include <filesystem>

#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "apps/record/sqlite.h"
#include "apps/record/store/sql_connection.h"
#include "apps/runtime/clock.h"

namespace palpa::record {
namespace {

constexpr int kRecordsApplicationId = 0x70616c52;  // "palR"
constexpr int kWaitForOthers_ms = 20'000;          // eight stations that write at once take turns

void makeFile(const std::string& file) {
  if (const std::error_code problem = os::createPrivate(file))
    failFile("cannot be opened for writing", "records file " + file, problem,
             problem == std::errc::too_many_symbolic_link_levels
                 ? "Or give the file itself with --records"
                 : "");
}

/// What the file begins with, and its size. It is read with SQLite's own descriptor: to close
/// another one would let go of every lock that this program has on the file.
/// https://www.sqlite.org/howtocorrupt.html, 2.2
struct Beginning {
  char bytes[18] = {};
  sqlite3_int64 size = 0;
};

Beginning beginningOf(sqlite3* handle) {
  Beginning start;
  sqlite3_file* file = nullptr;
  if (sqlite3_file_control(handle, "main", SQLITE_FCNTL_FILE_POINTER, &file) != SQLITE_OK ||
      !file->pMethods || file->pMethods->xFileSize(file, &start.size) != SQLITE_OK)
    return {};  // the first statement says why
  file->pMethods->xRead(file, start.bytes, sizeof start.bytes, 0);
  return start;
}

/// SQLite fills up what is missing of the last page and says nothing. With a log beside, the file
/// may well be in the middle of being written.
void checkWhole(const std::string& file, const Beginning& start) {
  const auto high = static_cast<unsigned char>(start.bytes[16]),
             low = static_cast<unsigned char>(start.bytes[17]);
  const int page = high == 0 && low == 1 ? 65536 : 256 * high + low;  // as the file format has it
  std::error_code none;
  const std::uintmax_t log = std::filesystem::file_size(file + "-wal", none);
  if (page == 0 || (!none && log > 0) || start.size % page == 0) return;
  throw Error(
      "is damaged (it was cut short)", "records file " + file,
      "Restore a backup: palpa records restore; keep the damaged file for `sqlite3 FILE .recover`");
}

void checkKind(Database& database) {
  const std::string file = database.file().string();
  const Beginning start = beginningOf(database.handle());
  if (start.size == 0) return;  // new
  if (start.size < 16 || std::memcmp(start.bytes, "SQLite format 3", 16) != 0)
    throw Error("is not a records file", "records file " + file,
                "Give the right file, or restore it from a backup");
  checkWhole(file, start);
}

/// With a log and its index beside it somebody writes, or was killed: what stands in the log is
/// read as well. Otherwise SQLite would make both: it is told that nobody writes.
Database::Mode readingMode(const std::string& file) {
  std::error_code none;
  const bool in_use = std::filesystem::file_size(file + "-wal", none) > 0 && !none &&
                      std::filesystem::exists(file + "-shm", none);
  return in_use ? Database::Mode::read : Database::Mode::read_immutable;
}

class SqliteConnection final : public SqlConnection {
 public:
  SqliteConnection(const std::string& file, Access access)
      : database_(file, access == Access::write ? Database::Mode::write : readingMode(file)) {
    checkKind(database_);
    sqlite3_busy_timeout(database_.handle(), kWaitForOthers_ms);
    guarded([&] { access == Access::write ? prepare() : check(); });
  }

  SqlRows query(const std::string& sql, const std::vector<SqlValue>& values) override {
    return guarded([&] { return answer(sql, values); });
  }
  std::unique_ptr<SqlCursor> cursor(const std::string& sql,
                                    const std::vector<SqlValue>& values) override {
    return guarded([&] { return std::make_unique<Cursor>(*this, sql, values); });
  }
  void script(const std::string& statements) override {
    guarded([&] { database_.exec(statements); });
  }
  /// Whoever reads sees the file as it is at the first look, and others may write meanwhile.
  void begin(Access access) override {
    script(access == Access::write ? "BEGIN IMMEDIATE" : "BEGIN");
  }
  void commit() override { script("COMMIT"); }
  void rollback() noexcept override {
    sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
  void lockSchema() override {}  // a transaction for writing has the file to itself
  bool leaveNoTrace() override {
    script("VACUUM");
    return query("PRAGMA wal_checkpoint(TRUNCATE)", {}).integer(0, 0) == 0;
  }
  bool hasTable(const std::string& name) override {
    return !query("SELECT 1 FROM sqlite_master WHERE type='table' AND name=$1", {name}).empty();
  }
  std::string place() const override { return "records file " + database_.file().string(); }

 private:
  class Cursor final : public SqlCursor {
   public:
    Cursor(SqliteConnection& owner, const std::string& sql, const std::vector<SqlValue>& values)
        : owner_(owner), statement_(owner.prepared(sql, values)) {}
    bool next() override {
      return owner_.guarded([this] { return statement_.step(); });
    }
    std::string_view text(std::size_t column) const override {
      return statement_.textView(static_cast<int>(column));
    }
    std::int64_t integer(std::size_t column) const override {
      return statement_.integer(static_cast<int>(column));
    }
    double real(std::size_t column) const override {
      return statement_.real(static_cast<int>(column));
    }
    std::vector<SqlValue> row() const override { return rowOf(statement_); }

   private:
    SqliteConnection& owner_;
    Statement statement_;
  };

  void prepare() {
    const std::int64_t id = ownId();
    switchToLog();
    database_.exec("PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON; PRAGMA secure_delete=ON");
    checkPages();
    if (id == 0) database_.exec("PRAGMA application_id=" + std::to_string(kRecordsApplicationId));
  }

  void check() {
    ownId();
    checkPages();
  }

  /// 0: a file that holds nothing yet. Both are of one moment: another station may be making it.
  std::int64_t ownId() {
    database_.exec("BEGIN");
    const std::int64_t id = database_.integer("PRAGMA application_id"),
                       tables = database_.integer("SELECT count(*) FROM sqlite_master");
    database_.exec("COMMIT");
    if (id == kRecordsApplicationId || (id == 0 && tables == 0)) return id;
    throw Error("is a database of another program", place(),
                "Give the right file; a session's evidence is added by palpa records add");
  }

  void checkPages() {
    if (database_.text("PRAGMA quick_check") != "ok")
      failDamaged("its pages contradict each other");
  }

  [[noreturn]] void failDamaged(const std::string& reason) const {
    throw Error("is damaged (" + reason + ")", place(),
                "Restore a backup: palpa records restore; keep the damaged file for `sqlite3 FILE "
                ".recover`");
  }

  Statement prepared(const std::string& sql, const std::vector<SqlValue>& values) {
    Statement statement(database_, sql);
    int number = 0;
    for (const SqlValue& value : values)
      std::visit([&](const auto& v) { statement.bindNumbered(number, v); }, (++number, value));
    return statement;
  }

  SqlRows answer(const std::string& sql, const std::vector<SqlValue>& values) {
    Statement statement = prepared(sql, values);
    SqlRows rows;
    while (statement.step()) rows.add(rowOf(statement));
    return rows;
  }

  /// A file that others hold, or a full disk, may do later.
  template <typename Action>
  auto guarded(Action action) -> decltype(action()) {
    try {
      return action();
    } catch (const DatabaseError& e) {
      const bool later = e.code == SQLITE_BUSY || e.code == SQLITE_LOCKED ||
                         e.code == SQLITE_FULL || e.code == SQLITE_IOERR ||
                         e.code == SQLITE_PROTOCOL;
      const bool broken = e.code == SQLITE_CORRUPT || e.code == SQLITE_NOTADB ||
                          e.code == SQLITE_ERROR;  // the last: tables are not as they were made
      if (broken) failDamaged(reasonOf(e.code));
      if (!later) throw;
      throw StoreUnreachable(std::string("cannot be written now (") + reasonOf(e.code) + ")",
                             place(),
                             "Free the disk or close what holds the file; trials are kept on this "
                             "station and sent later");
    }
  }

  /// Readers and a writer side by side. Several programs may ask for it at once on a new file,
  /// which SQLite answers without waiting.
  void switchToLog() {
    for (int tries = 200;; --tries) try {
        database_.text("PRAGMA journal_mode=WAL");
        return;
      } catch (const DatabaseError& e) {
        if (e.code != SQLITE_BUSY || tries == 0) throw;
        runtime::SteadyClock().sleepUntil(20 * runtime::kMillisecond);
      }
  }

  static std::vector<SqlValue> rowOf(const Statement& statement) {
    std::vector<SqlValue> row;
    for (int c = 0; c < statement.columns(); ++c) row.push_back(statement.value(c));
    return row;
  }

  Database database_;
};

}  // namespace

std::unique_ptr<SqlConnection> openSqlite(const std::string& file, Access access) {
  if (access == Access::write) makeFile(file);
  return std::make_unique<SqliteConnection>(file, access);
}

}  // namespace palpa::record

#include "apps/record/sqlite.h"

#include <sqlite3.h>

#include <cerrno>
#include <limits>

namespace palpa::record {
namespace {

/// How long a commit waits for another program that writes to the same file.
constexpr int kBusy_ms = 500;

/// A primary result code: why, and what to do about it.
struct Refusal {
  const char *why, *remedy;
};

Refusal refusalOf(int code) {
  switch (code) {
    case SQLITE_FULL:
      return {"the disk is full",
              "The disk is full: free some space; what was committed before is safe"};
    case SQLITE_IOERR:
      return {"the disk refuses",
              "The disk refused to read or write: check free space, quota and the drive; what was "
              "committed before is safe"};
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return {"it may not be written",
              "Make the file and its folder writable, or choose another folder with --out"};
    case SQLITE_CANTOPEN:
      return {"it is not there, or may not be opened",
              "Check that the folder exists and may be read and written, or choose another with "
              "--out"};
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {"it is in use", "Another program holds the file: close it and try again"};
    case SQLITE_NOMEM:
      return {"there is not enough memory", "Close other programs, then try again"};
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
      return {"it is damaged, or something else",
              "The file is damaged or no session file: restore it from a backup, or save what is "
              "left with `sqlite3 FILE .recover`"};
    default:
      return {"its content is not as it must be",
              "Check the file and its folder, or choose another folder with --out"};
  }
}

Refusal refusalOf(sqlite3* handle) {
  const int code = sqlite3_errcode(handle) & 0xff;  // of none at all: no memory
  const int system = handle ? sqlite3_system_errno(handle) : 0;
  if (code == SQLITE_CANTOPEN && (system == EMFILE || system == ENFILE))
    return {"too many files are open",
            "Close other programs, or allow more open files (ulimit -n), then try again"};
  return refusalOf(code);
}

/// A path as SQLite's URI, so that options can be appended.
std::string uri(const std::filesystem::path& file, const std::string& options) {
  static constexpr char kHex[] = "0123456789ABCDEF";
  std::string result = "file:";
  for (const char c : std::filesystem::absolute(file).string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '%' || c == '?' || c == '#' || byte < 0x20) {
      result += {'%', kHex[byte >> 4], kHex[byte & 15]};
    } else {
      result += c;
    }
  }
  return result + options;
}

}  // namespace

const char* reasonOf(int code) { return refusalOf(code).why; }

void Database::Close::operator()(sqlite3* handle) const noexcept { sqlite3_close_v2(handle); }

Database::Database(const std::filesystem::path& file, Mode mode) : file_(file) {
  const int access = mode == Mode::write ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READONLY;
  const std::string name = uri(file, mode == Mode::read_immutable ? "?immutable=1" : "");
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(name.c_str(), &handle,
                                   access | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) fail("cannot be opened");
  sqlite3_busy_timeout(handle, kBusy_ms);
  // Files come from elsewhere, too: believe nothing that their schema says, and check every cell.
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  if (mode != Mode::write) {
    // Reading leaves the evidence as it is: a log left by a killed process is read, not merged.
    sqlite3_db_config(handle, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  }
  exec("PRAGMA cell_size_check=ON");
}

void Database::fail(const std::string& doing) const {
  const Refusal refusal = refusalOf(handle_.get());
  throw DatabaseError(sqlite3_errcode(handle_.get()) & 0xff, doing + " (" + refusal.why + ")",
                      file_.string(), refusal.remedy);
}

void Database::exec(const std::string& sql) {
  if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
    fail("cannot be read or written");
  }
}

std::int64_t Database::integer(const std::string& sql) {
  Statement statement(*this, sql);
  return statement.step() ? statement.integer(0) : 0;
}

std::string Database::text(const std::string& sql) {
  Statement statement(*this, sql);
  return statement.step() ? statement.text(0) : "";
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const noexcept {
  sqlite3_finalize(statement);
}

Statement::Statement(Database& database, const std::string& sql) : database_(&database) {
  sqlite3_stmt* statement = nullptr;
  check(sqlite3_prepare_v2(database.handle(), sql.c_str(), -1, &statement, nullptr));
  statement_.reset(statement);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) database_->fail("cannot be read or written");
}

void Statement::rewind() {
  sqlite3_reset(statement_.get());  // repeats an error already reported by step
  sqlite3_clear_bindings(statement_.get());
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  database_->fail("cannot be read or written");
}

void Statement::run() {
  step();
  sqlite3_reset(statement_.get());
}

/// Names are searched one after the other; most stand in the order of their numbers.
int Statement::indexOf(int number) const {
  const std::string name = '$' + std::to_string(number);
  const char* there = sqlite3_bind_parameter_name(statement_.get(), number);
  return there && there == name ? number
                                : sqlite3_bind_parameter_index(statement_.get(), name.c_str());
}

void Statement::bindOne(int index, std::monostate) {
  check(sqlite3_bind_null(statement_.get(), index));
}

void Statement::bindOne(int index, std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), index, value));
}

void Statement::bindOne(int index, double value) {
  check(sqlite3_bind_double(statement_.get(), index, value));
}

void Statement::bindOne(int index, std::string_view value) {
  check(sqlite3_bind_text64(statement_.get(), index, value.empty() ? "" : value.data(),
                            value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
}

void Statement::bindOne(int index, ByteView value) {
  check(value.empty() ? sqlite3_bind_zeroblob(statement_.get(), index, 0)
                      : sqlite3_bind_blob64(statement_.get(), index, value.data(), value.size(),
                                            SQLITE_TRANSIENT));
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double Statement::real(int column) const {
  return isNull(column) ? std::numeric_limits<double>::quiet_NaN()
                        : sqlite3_column_double(statement_.get(), column);
}

std::string_view Statement::textView(int column) const {
  const auto* data = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return data ? std::string_view(data, static_cast<std::size_t>(size)) : std::string_view();
}

ByteView Statement::blob(int column) const {
  const auto* data =
      static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), column));
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return data ? ByteView(data, static_cast<std::size_t>(size)) : ByteView();
}

bool Statement::isNull(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

std::variant<std::monostate, std::int64_t, double, std::string> Statement::value(int column) const {
  switch (sqlite3_column_type(statement_.get(), column)) {
    case SQLITE_NULL:
      return std::monostate{};
    case SQLITE_INTEGER:
      return integer(column);
    case SQLITE_FLOAT:
      return real(column);
    default:
      return text(column);
  }
}

int Statement::columns() const { return sqlite3_column_count(statement_.get()); }

Transaction::Transaction(Database& database) : database_(database) {
  database_.exec("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (open_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_.exec("COMMIT");
  open_ = false;
}

}  // namespace palpa::record

#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "anatomy/base/error.h"

namespace palpa::record {

/// Null, whole number, number, text. A number that is none (NaN) is stored as null.
using SqlValue = std::variant<std::monostate, std::int64_t, double, std::string>;

/// Rows of an answer; columns by number from 0.
class SqlRows {
 public:
  std::size_t size() const { return rows_.size(); }
  bool empty() const { return rows_.empty(); }
  bool isNull(std::size_t row, std::size_t column) const { return at(row, column).index() == 0; }
  std::string text(std::size_t row, std::size_t column) const;      ///< "" for null
  std::int64_t integer(std::size_t row, std::size_t column) const;  ///< 0 for null
  double real(std::size_t row, std::size_t column) const;           ///< NaN for null
  const std::vector<SqlValue>& row(std::size_t row) const { return rows_.at(row); }
  void add(std::vector<SqlValue> row) { rows_.push_back(std::move(row)); }

 private:
  const SqlValue& at(std::size_t row, std::size_t column) const { return rows_.at(row).at(column); }
  std::vector<std::vector<SqlValue>> rows_;
};

/// Rows of an answer one after the other: whoever reads holds one, however many there are. Columns
/// by number from 0; null as in SqlRows.
class SqlCursor {
 public:
  virtual ~SqlCursor() = default;
  virtual bool next() = 0;  ///< a row is there; false: there are no more
  virtual std::string_view text(std::size_t column) const = 0;  ///< valid until `next`
  virtual std::int64_t integer(std::size_t column) const = 0;
  virtual double real(std::size_t column) const = 0;
  virtual std::vector<SqlValue> row() const = 0;
};

/// The store cannot be reached now; what was to be written must be kept and tried again.
class StoreUnreachable : public Error {
 public:
  using Error::Error;
};

/// What a transaction, or a connection, may do.
enum class Access { write, read };

/// The subset of SQL that SQLite and PostgreSQL share: parameters $1, $2, ... in the order of their
/// numbers, ON CONFLICT DO NOTHING, RETURNING. One connection, one thread. Everything throws Error
/// in words; a lost or refused connection StoreUnreachable. One that is lost stays lost.
class SqlConnection {
 public:
  virtual ~SqlConnection() = default;
  virtual SqlRows query(const std::string& sql, const std::vector<SqlValue>& values = {}) = 0;
  /// Within a transaction, which it must not outlive; other requests may come between its rows. A
  /// server sends them a thousand at a time.
  virtual std::unique_ptr<SqlCursor> cursor(const std::string& sql,
                                            const std::vector<SqlValue>& values = {}) = 0;
  virtual void script(
      const std::string& statements) = 0;  ///< several, without parameters, inside a transaction
  /// `read`: all that is read in it is of one moment, and nobody waits for it.
  virtual void begin(Access access) = 0;
  virtual void commit() = 0;
  virtual void rollback() noexcept = 0;
  virtual void
  lockSchema() = 0;  ///< within a transaction, to its end: nobody else changes the tables
  /// Outside a transaction: what was deleted leaves no byte in the file and its log. False: others
  /// read in it now. Of a server nothing is done: its own clearing sees to that.
  virtual bool leaveNoTrace() = 0;
  virtual bool hasTable(const std::string& name) = 0;
  virtual std::string place() const = 0;  ///< for messages; never a password
};

/// Begins; rolls back unless committed.
class SqlTransaction {
 public:
  explicit SqlTransaction(SqlConnection& connection, Access access = Access::write)
      : connection_(connection) {
    connection_.begin(access);
  }
  ~SqlTransaction() {
    if (open_) connection_.rollback();
  }
  SqlTransaction(const SqlTransaction&) = delete;
  SqlTransaction& operator=(const SqlTransaction&) = delete;
  void commit() {
    connection_.commit();
    open_ = false;
  }

 private:
  SqlConnection& connection_;
  bool open_ = true;
};

/// Rows into a table, many in a statement: a server is asked once for some hundred values.
/// `columns`: "a,b,c".
void insertRows(SqlConnection& connection, const std::string& table, const std::string& columns,
                const std::vector<std::vector<SqlValue>>& rows);

/// "postgresql://..." or "postgres://...": a server.
bool isServer(const std::string& address);

/// Records are the path of a file or the address of a server. Throws UsageError for any other
/// scheme, for a server's settings as words ("host=... password=..."), which are no file's name,
/// and for an address that holds a password. A message never repeats what may be secret.
void requireAddress(const std::string& address);

/// What libpq takes from the environment where an address leaves it out: PGHOST, PGHOSTADDR (it
/// counts instead of any host), PGSERVICE.
struct ServerDefaults {
  std::string host = {}, number = {}, service = {};
};
ServerDefaults serverDefaults();

/// The address with the encryption that it needs: beyond this computer TLS, and a certificate that
/// is the server's (sslmode=verify-full, or verify-ca where the address says so). Throws UsageError
/// for one that asks for less there. On this computer (no host, a socket, localhost, 127.x, ::1)
/// it stays as it is: TLS where the server has it, libpq's default.
std::string withEncryption(const std::string& address, const ServerDefaults& defaults);

/// "postgresql://[user@]host[:port]/database" or the path of an SQLite file, which is made where
/// there is none (readable by its owner only). A URL that holds a password is refused: it would end
/// in station files and process lists; libpq finds it in PGPASSWORD or ~/.pgpass. What is neither
/// is refused, and so is a server beyond this computer without a checked certificate.
std::unique_ptr<SqlConnection> connect(const std::string& url);

/// The same to read only: nothing is made, written or migrated, neither in the store nor, of a
/// file, beside it. The file must exist and hold something.
std::unique_ptr<SqlConnection> connectToRead(const std::string& url);

std::unique_ptr<SqlConnection> openSqlite(const std::string& file, Access access);
/// `silence`: a server that answers a request with nothing for so long is given up, unless it is
/// reached by a local (Unix) socket.
std::unique_ptr<SqlConnection> openPostgres(
    const std::string& url, Access access,
    std::chrono::milliseconds silence = std::chrono::seconds(20));

}  // namespace palpa::record

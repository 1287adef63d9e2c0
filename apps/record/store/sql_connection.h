#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "anatomy/base/error.h"
#include "apps/record/store/records_address.h"

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

/// The store cannot be reached now; what was to be written must be kept and tried again.
class StoreUnreachable : public Error {
 public:
  using Error::Error;
};

/// The subset of SQL that SQLite and PostgreSQL share: parameters $1, $2, ... in the order of their
/// numbers, ON CONFLICT DO NOTHING, RETURNING. One connection, one thread. Everything throws Error
/// in words; a lost or refused connection StoreUnreachable. One that is lost stays lost.
class SqlConnection {
 public:
  virtual ~SqlConnection() = default;
  virtual SqlRows query(const std::string& sql, const std::vector<SqlValue>& values = {}) = 0;
  virtual void script(
      const std::string& statements) = 0;  ///< several, without parameters, inside a transaction
  virtual void begin() = 0;                ///< for writing
  virtual void commit() = 0;
  virtual void rollback() noexcept = 0;
  virtual void
  lockSchema() = 0;           ///< within a transaction, to its end: nobody else changes the tables
  virtual void freeze() = 0;  ///< first in a transaction: all that it reads is of one moment
  /// Outside a transaction: what was deleted leaves no byte in the file and its log. False: others
  /// read in it now. Of a server nothing is done: its own clearing sees to that.
  virtual bool leaveNoTrace() = 0;
  virtual bool hasTable(const std::string& name) = 0;
  virtual std::string place() const = 0;  ///< for messages; never a password
};

/// Begins; rolls back unless committed.
class SqlTransaction {
 public:
  explicit SqlTransaction(SqlConnection& connection) : connection_(connection) {
    connection_.begin();
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

/// "postgresql://[user@]host[:port]/database" or the path of an SQLite file, which is made where
/// there is none (readable by its owner only). A URL that holds a password is refused: it would end
/// in station files and process lists; libpq finds it in PGPASSWORD or ~/.pgpass. What is neither
/// is refused, and so is a server beyond this computer without a checked certificate.
std::unique_ptr<SqlConnection> connect(const std::string& url);

/// The same to read only: nothing is made, written or migrated, neither in the store nor, of a
/// file, beside it. The file must exist and hold something.
std::unique_ptr<SqlConnection> connectToRead(const std::string& url);

enum class Access { write, read };
std::unique_ptr<SqlConnection> openSqlite(const std::string& file, Access access);
/// `silence`: a server that answers a request with nothing for so long is given up, unless it is
/// reached by a local (Unix) socket.
std::unique_ptr<SqlConnection> openPostgres(
    const std::string& url, Access access,
    std::chrono::milliseconds silence = std::chrono::seconds(20));

}  // namespace palpa::record

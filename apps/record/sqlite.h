#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "anatomy/base/bytes.h"
#include "anatomy/base/error.h"

struct sqlite3;
struct sqlite3_stmt;

namespace palpa::record {

/// An answer of SQLite, in words that somebody can act on. `code` is SQLite's primary result code.
class DatabaseError : public Error {
 public:
  DatabaseError(int result_code, const std::string& what, const std::string& where,
                const std::string& remedy)
      : Error(what, where, remedy), code(result_code) {}
  const int code;
};

/// Why SQLite gave this primary result code, as a clause: "the disk is full".
const char* reasonOf(int code);

/// One connection. Not shared between threads.
class Database {
 public:
  enum class Mode {
    write,          ///< read and write an existing (possibly empty) file
    read,           ///< read only; sees what a write-ahead log beside the file holds
    read_immutable  ///< read only, no locks, no files beside it: for folders nobody can write to
  };
  Database(const std::filesystem::path& file, Mode mode);

  void exec(const std::string& sql);
  std::int64_t integer(const std::string& sql);  ///< first column of the first row; 0 without a row
  std::string text(const std::string& sql);  ///< first column of the first row; "" without a row

  [[noreturn]] void fail(const std::string& doing) const;  ///< throws DatabaseError
  const std::filesystem::path& file() const { return file_; }
  sqlite3* handle() const { return handle_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* handle) const noexcept;
  };
  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement. Parameters are bound in order by `bind` or each by its name, columns are
/// read by number from 0.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);

  template <typename... Values>
  Statement& bind(const Values&... values) {
    rewind();
    int index = 0;
    (bindOne(++index, values), ...);
    return *this;
  }
  /// The parameter "$3" of number 3; nothing where the statement does not use it.
  template <typename Value>
  void bindNumbered(int number, const Value& value) {
    if (const int index = indexOf(number); index > 0) bindOne(index, value);
  }
  bool step();  ///< true: a row is there
  void run();   ///< for statements without rows

  std::int64_t integer(int column) const;
  double real(int column) const;  ///< NULL (how SQLite stores not-a-number) becomes NaN
  std::string text(int column) const { return std::string(textView(column)); }
  std::string_view textView(int column) const;  ///< valid until the next step
  ByteView blob(int column) const;              ///< valid until the next step
  bool isNull(int column) const;
  int columns() const;
  /// As it is stored; bytes as a text.
  std::variant<std::monostate, std::int64_t, double, std::string> value(int column) const;

 private:
  int indexOf(int number) const;  ///< 0: there is none
  void rewind();
  void bindOne(int index, std::monostate null);
  void bindOne(int index, std::int64_t value);
  void bindOne(int index, int value) { bindOne(index, static_cast<std::int64_t>(value)); }
  void bindOne(int index, double value);
  void bindOne(int index, std::string_view value);
  void bindOne(int index, const std::string& value) { bindOne(index, std::string_view(value)); }
  void bindOne(int index, ByteView value);
  void check(int code) const;

  struct Finalize {
    void operator()(sqlite3_stmt* statement) const noexcept;
  };
  Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// Begins at once, rolls back unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace palpa::record

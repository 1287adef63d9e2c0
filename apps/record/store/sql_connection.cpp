#include "apps/record/store/sql_connection.h"

#include <algorithm>
#include <limits>

namespace palpa::record {
namespace {

std::unique_ptr<SqlConnection> open(const std::string& url, Access access) {
  requireAddress(url);
  return isServer(url) ? openPostgres(url, access) : openSqlite(url, access);
}

/// "($1,$2),($3,$4)"
std::string placeholders(std::size_t rows, std::size_t columns) {
  std::string text;
  for (std::size_t i = 0; i < rows * columns; ++i) {
    text += i % columns > 0 ? ",$" : i > 0 ? "),($" : "($";
    text += std::to_string(i + 1);
  }
  return text + ')';
}

}  // namespace

void insertRows(SqlConnection& connection, const std::string& table, const std::string& columns,
                const std::vector<std::vector<SqlValue>>& rows) {
  constexpr std::size_t kMostValues = 500;  // both kinds of store take thousands
  for (std::size_t from = 0, to = 0; from < rows.size(); from = to) {
    to = std::min(rows.size(), from + std::max<std::size_t>(1, kMostValues / rows[from].size()));
    std::vector<SqlValue> values;
    for (std::size_t r = from; r < to; ++r)
      values.insert(values.end(), rows[r].begin(), rows[r].end());
    connection.query("INSERT INTO " + table + "(" + columns + ") VALUES" +
                         placeholders(to - from, rows[from].size()),
                     values);
  }
}

std::string SqlRows::text(std::size_t row, std::size_t column) const {
  const SqlValue& v = at(row, column);
  if (const auto* text = std::get_if<std::string>(&v)) return *text;
  if (const auto* number = std::get_if<std::int64_t>(&v)) return std::to_string(*number);
  return "";
}

std::int64_t SqlRows::integer(std::size_t row, std::size_t column) const {
  const auto* number = std::get_if<std::int64_t>(&at(row, column));
  return number ? *number : 0;
}

double SqlRows::real(std::size_t row, std::size_t column) const {
  const SqlValue& v = at(row, column);
  if (const auto* number = std::get_if<double>(&v)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&v)) return static_cast<double>(*whole);
  return std::numeric_limits<double>::quiet_NaN();
}

std::unique_ptr<SqlConnection> connect(const std::string& url) { return open(url, Access::write); }
std::unique_ptr<SqlConnection> connectToRead(const std::string& url) {
  return open(url, Access::read);
}

}  // namespace palpa::record

#include "apps/record/store/sql_connection.h"

#include <limits>

namespace palpa::record {
namespace {

std::unique_ptr<SqlConnection> open(const std::string& url, Access access) {
  requireAddress(url);
  return isServer(url) ? openPostgres(url, access) : openSqlite(url, access);
}

}  // namespace

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

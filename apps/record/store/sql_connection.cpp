#include "apps/record/store/sql_connection.h"

#include <limits>

namespace palpa::record {
namespace {

constexpr std::string_view kSchemes[] = {"postgresql://", "postgres://"};

/// user:password@ between scheme and host.
bool hasPassword(const std::string& url) {
  const std::size_t start = url.find("://") + 3, at = url.find('@', start),
                    colon = url.find(':', start);
  const bool in_authority = at != std::string::npos && at < url.find('/', start);
  return (in_authority && colon < at) || url.find("password=") != std::string::npos;
}

std::unique_ptr<SqlConnection> open(const std::string& url, Access access) {
  if (!isServer(url)) {
    if (url.empty() || url.find("://") != std::string::npos)
      throw UsageError("is neither a file nor a postgresql:// address", "records \"" + url + "\"",
                       "Give the path of a file, or postgresql://user@host/database");
    return openSqlite(url, access);
  }
  if (hasPassword(url))
    throw UsageError("holds a password, which others could read", "records address",
                     "Leave it out and put it into ~/.pgpass or PGPASSWORD");
  return openPostgres(url, access);
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

bool isServer(const std::string& url) {
  for (const std::string_view scheme : kSchemes)
    if (url.starts_with(scheme)) return true;
  return false;
}

std::unique_ptr<SqlConnection> connect(const std::string& url) { return open(url, Access::write); }
std::unique_ptr<SqlConnection> connectToRead(const std::string& url) {
  return open(url, Access::read);
}

}  // namespace palpa::record

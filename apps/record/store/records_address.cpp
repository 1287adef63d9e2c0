#include "apps/record/store/sql_connection.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include "anatomy/base/error.h"

namespace palpa::record {
namespace {

constexpr std::array<std::string_view, 2> kSchemes{"postgresql://", "postgres://"};
/// Words by which libpq knows a server, where no address is given.
constexpr std::array<std::string_view, 9> kSettings{
    "host", "hostaddr", "port", "dbname", "user", "password", "passfile", "service", "sslmode"};

using Settings = std::vector<std::pair<std::string, std::string>>;

struct ServerAddress {
  std::string user;  ///< and password
  std::vector<std::string> hosts;
  Settings settings;
  bool asks = false;  ///< there is a "?", with or without settings
  bool has(const std::string& name) const {
    return std::any_of(settings.begin(), settings.end(),
                       [&](const auto& one) { return one.first == name; });
  }
};

std::vector<std::string> partsOf(std::string_view text, char between) {
  std::vector<std::string> parts;
  for (std::size_t end = 0; end != std::string_view::npos;) {
    end = text.find(between);
    parts.emplace_back(text.substr(0, end));
    if (end != std::string_view::npos) text.remove_prefix(end + 1);
  }
  return parts;
}

int valueOfDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// "%2F" is "/".
std::string decoded(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? valueOfDigit(text[i + 1]) : -1,
              low = high >= 0 ? valueOfDigit(text[i + 2]) : -1;
    plain += low >= 0 ? static_cast<char>(16 * high + low) : text[i];
    if (low >= 0) i += 2;
  }
  return plain;
}

/// "[::1]:5432", "server:5432", "%2Frun" without the port and the brackets.
std::string hostOf(const std::string& text) {
  if (text.starts_with('[')) return text.substr(1, text.find(']') - 1);
  return decoded(text.substr(0, text.find(':')));
}

/// As libpq reads it: an "@" before the first "/" ends user and password, whatever they hold.
ServerAddress parsed(const std::string& address) {
  ServerAddress server;
  std::string_view rest = address;
  rest.remove_prefix(rest.find("://") + 3);
  if (const std::size_t at = rest.find('@'); at < rest.find('/')) {
    server.user = rest.substr(0, at);
    rest.remove_prefix(at + 1);
  }
  const std::size_t asks = rest.find('?');
  server.asks = asks != std::string_view::npos;
  if (asks != std::string_view::npos)
    for (const std::string& one : partsOf(rest.substr(asks + 1), '&'))
      server.settings.emplace_back(
          decoded(one.substr(0, one.find('='))),
          one.find('=') == std::string::npos ? "" : decoded(one.substr(one.find('=') + 1)));
  const std::string_view authority = rest.substr(0, std::min(rest.find('/'), asks));
  for (const std::string& host : partsOf(authority, ',')) server.hosts.push_back(hostOf(host));
  return server;
}

bool isOnThisComputer(const std::string& host) {
  const bool numbers = host.find_first_not_of("0123456789.") == std::string::npos;
  return host.starts_with('/') || host.starts_with('@') || host == "localhost" || host == "::1" ||
         (numbers && host.starts_with("127."));
}

bool allOnThisComputer(const std::string& hosts) {
  const std::vector<std::string> all = partsOf(hosts, ',');
  return std::all_of(all.begin(), all.end(),
                     [](const std::string& one) { return one.empty() || isOnThisComputer(one); });
}

/// Each of them may be the one that answers. Settings behind the "?" count instead of the
/// authority's.
bool allOnThisComputer(const ServerAddress& server, const ServerDefaults& defaults) {
  if (server.has("service") || !defaults.service.empty()) return false;  // a file says where
  if (!server.has("hostaddr") && !allOnThisComputer(defaults.number)) return false;
  std::vector<std::string> hosts = server.hosts;
  for (const char* name : {"host", "hostaddr"})
    for (const auto& [setting, value] : server.settings)
      if (setting == name) hosts = partsOf(value, ',');
  return std::all_of(hosts.begin(), hosts.end(), [&](const std::string& host) {
    return host.empty() ? allOnThisComputer(defaults.host) : isOnThisComputer(host);
  });
}

bool holdsPassword(const std::string& address) {
  const ServerAddress server = parsed(address);
  return server.user.find(':') != std::string::npos || server.has("password") ||
         server.has("sslpassword");
}

/// "host=server password=..." : a known word at the beginning or after a blank, then "=".
bool looksLikeSettings(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i > 0 && !std::isspace(static_cast<unsigned char>(text[i - 1]))) continue;
    for (const std::string_view word : kSettings) {
      if (text.compare(i, word.size(), word) != 0) continue;
      const std::size_t next = text.find_first_not_of(" \t", i + word.size());
      if (next != std::string::npos && text[next] == '=') return true;
    }
  }
  return false;
}

bool isWordOfScheme(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '+' || c == '-' || c == '.';
  });
}

std::string fromEnvironment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

constexpr char kGiveOne[] =
    "Give the path of a file, or postgresql://user@host/database; a password belongs into "
    "~/.pgpass or PGPASSWORD";

}  // namespace

bool isServer(const std::string& address) {
  return std::any_of(kSchemes.begin(), kSchemes.end(),
                     [&](std::string_view scheme) { return address.starts_with(scheme); });
}

void requireAddress(const std::string& address) {
  if (address.empty()) throw UsageError("is empty", "records address", kGiveOne);
  if (isServer(address)) {
    if (!holdsPassword(address)) return;
    throw UsageError("holds a password, which others could read", "records address",
                     "Leave it out and put it into ~/.pgpass or PGPASSWORD");
  }
  if (looksLikeSettings(address))
    throw UsageError("is a server's settings as words, which would become a file's name",
                     "records address", kGiveOne);
  if (const std::size_t end = address.find("://"); end != std::string::npos) {
    const std::string scheme = address.substr(0, end);
    throw UsageError(
        "is neither a file nor a postgresql:// address",
        isWordOfScheme(scheme) ? "records address " + scheme + "://..." : "records address",
        kGiveOne);
  }
}

ServerDefaults serverDefaults() {
  return {.host = fromEnvironment("PGHOST"),
          .number = fromEnvironment("PGHOSTADDR"),
          .service = fromEnvironment("PGSERVICE")};
}

std::string withEncryption(const std::string& address, const ServerDefaults& defaults) {
  const ServerAddress server = parsed(address);
  if (allOnThisComputer(server, defaults)) return address;
  for (const auto& [name, value] : server.settings)
    if (name == "sslmode" && value != "verify-full" && value != "verify-ca")
      throw UsageError(
          "asks for less than a server whose certificate is checked (sslmode=" + value + ")",
          "records address",
          "Beyond this computer leave sslmode out; name the certificate of who signs the "
          "server's: ?sslrootcert=FILE");
  if (server.has("sslmode")) return address;
  return address + (server.asks ? "&" : "?") + "sslmode=verify-full";
}

}  // namespace palpa::record

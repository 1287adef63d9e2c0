#include "apps/link/lrs_client.h"

#include <cstdlib>
#include <fstream>
#include <utility>

#include "anatomy/base/error.h"
#include "apps/os/socket.h"

namespace palpa::link {
namespace {

namespace fs = std::filesystem;
constexpr char kPasswordVariable[] = "PALPA_XAPI_PASSWORD";

bool isThisComputer(const std::string& host) {
  return host == "localhost" || host == "::1" || os::isLoopbackAddress(host);
}

UsageError noAddress(const std::string& why) {
  return UsageError(
      why, "--to",
      "Give the address of the learning record store, such as https://lrs.centre.example/xapi");
}

/// "host:8443", "[::1]:80" -> the host.
std::string hostIn(const std::string& authority) {
  const bool bracketed = authority.starts_with("[");
  const std::size_t end = bracketed ? authority.find(']') : authority.find(':');
  std::string host = bracketed ? authority.substr(1, end == std::string::npos ? end : end - 1)
                               : authority.substr(0, end);
  const std::size_t colon =
      bracketed ? (end == std::string::npos ? end : authority.find(':', end)) : end;
  const std::string port = colon == std::string::npos ? "" : authority.substr(colon + 1);
  if (host.empty() || port.find_first_not_of("0123456789") != std::string::npos || port.size() > 5)
    throw noAddress("names no computer");
  return host;
}

fs::path netrcFile() {
  if (const char* file = std::getenv("NETRC"); file && *file) return file;
  const char* home = std::getenv("HOME");
  return fs::path(home && *home ? home : ".") / ".netrc";
}

}  // namespace

Endpoint endpointOf(const std::string& url, bool insecure) {
  const bool tls = url.starts_with("https://");
  if (!tls && !url.starts_with("http://")) throw noAddress("is not an http or https address");
  const std::size_t start = tls ? 8 : 7;
  const std::size_t slash = std::min(url.find('/', start), url.size());
  const std::string authority = url.substr(start, slash - start);
  if (authority.find('@') != std::string::npos)
    throw UsageError(
        "holds a user or password, which others could read", "--to",
        std::string("Give --user, and the password in ") + kPasswordVariable + " or ~/.netrc");
  if (url.find_first_of("?# \t\r\n\\") != std::string::npos)
    throw noAddress("holds more than an address");
  Endpoint endpoint{url.substr(0, slash), hostIn(authority), url.substr(slash)};
  while (endpoint.path.ends_with("/")) endpoint.path.pop_back();
  if (endpoint.path.ends_with("/statements"))
    endpoint.path.resize(endpoint.path.size() - std::string("/statements").size());
  if (!tls && !insecure && !isThisComputer(endpoint.host))
    throw UsageError("would send results and password unprotected", "--to " + endpoint.text(),
                     "Use https; --insecure allows it where the network itself is safe");
  return endpoint;
}

Login loginIn(const fs::path& file, const std::string& host, const std::string& user) {
  std::ifstream stream(file);
  Login found;
  bool here = false;
  const auto fits = [&] {
    return here && !found.user.empty() && !found.password.empty() &&
           (user.empty() || found.user == user);
  };
  for (std::string word, value; stream >> word;) {
    if (word == "machine" || word == "default") {
      if (fits()) return found;
      found = {};
      here = word == "default" || (stream >> value && value == host);
    } else if (word == "login" && stream >> value) {
      found.user = value;
    } else if (word == "password" && stream >> value) {
      found.password = value;
    }
  }
  return fits() ? found : Login{};
}

Login loginFor(const std::string& host, const std::string& user) {
  if (const char* password = std::getenv(kPasswordVariable); password && *password && !user.empty())
    return {user, password};
  const fs::path file = netrcFile();
  std::error_code none;
  if (fs::exists(file, none)) {
    Login found = loginIn(file, host, user);
    const bool open_to_others = (fs::status(file, none).permissions() &
                                 (fs::perms::group_all | fs::perms::others_all)) != fs::perms::none;
    if (!found.user.empty() && open_to_others)
      throw UsageError("holds a password and may be read by others", file.string(),
                       "chmod 600 " + file.string());
    if (!found.user.empty()) return found;
  }
  if (user.empty()) return {};
  throw UsageError("has no password here", "--user " + user,
                   std::string("Set ") + kPasswordVariable + ", or add to ~/.netrc: machine " +
                       host + " login " + user + " password ...");
}

LrsClient::LrsClient(const Endpoint& endpoint, const Login& login, const LrsTimes& times)
    : endpoint_(endpoint), token_(login.token), client_(endpoint, times) {
  if (!login.user.empty()) client_.login(login.user, login.password);
}

LrsAnswer LrsClient::answerTo(WebRequest request) {
  constexpr char kVersionHeader[] = "X-Experience-API-Version", kVersion[] = "1.0.3";
  request.path = endpoint_.path + request.path;
  request.headers.emplace_back(kVersionHeader, kVersion);
  request.headers.emplace_back("Accept", "application/json");
  if (!token_.empty()) request.headers.emplace_back("Authorization", "Basic " + token_);
  WebAnswer answer = client_.answerTo(request);
  return {answer.status, answer.xapi_version.rfind("1.", 0) == 0, std::move(answer.body),
          std::move(answer.trouble)};
}

LrsAnswer LrsClient::put(const std::string& id, const std::string& statement) {
  return answerTo({.method = "PUT",
                   .path = "/statements?statementId=" + id,
                   .body = statement,
                   .content_type = "application/json"});
}

LrsAnswer LrsClient::get(const std::string& id, bool voided) {
  return read(std::string("/statements?") + (voided ? "voidedStatementId" : "statementId") + "=" +
              id);
}

LrsAnswer LrsClient::read(const std::string& resource) { return answerTo({.path = resource}); }

}  // namespace palpa::link

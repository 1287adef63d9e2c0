#include "apps/link/lrs_client.h"

#include <httplib.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "anatomy/base/error.h"
#include "apps/link/bounded_client.h"
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

namespace {

constexpr char kVersionHeader[] = "X-Experience-API-Version", kVersion[] = "1.0.3";
// A body in pieces says the length of each: more bytes than it holds
constexpr std::size_t kLongestBytes = 2 * LrsClient::kLongestAnswer;
constexpr char kTooLong[] = "the answer is too long (at most 1 MB)",
               kTooSlow[] = "the answer did not end within the time allowed";

std::string inWords(httplib::Error error) {
  switch (error) {
    case httplib::Error::Connection:
      return "nobody answers there";
    case httplib::Error::ConnectionTimeout:
      return "no connection within the time allowed";
    case httplib::Error::Read:
      return "the answer did not come, broke off or was none";
    case httplib::Error::Write:
      return "the connection broke off";
    case httplib::Error::SSLConnection:
      return "no protected connection could be agreed on";
    case httplib::Error::SSLLoadingCerts:
      return "the trusted certificates cannot be read";
    case httplib::Error::SSLServerVerification:
      return "its certificate is not trusted, or is another computer's";
    default:
      return "the request failed";
  }
}

}  // namespace

struct LrsClient::Impl {
  Impl(const Endpoint& e, const Login& login, const LrsTimes& times)
      : endpoint(e),
        whole(times.whole_s),
        client(boundedClient(e.host, portOf(e), e.origin.starts_with("https"),
                             {.body = kLongestBytes}, count)) {
    os::surviveBrokenConnections();  // a protection that is being agreed on may break
    client->set_connection_timeout(times.connect_s);
    client->set_read_timeout(times.answer_s);
    client->set_write_timeout(times.answer_s);
    client->set_keep_alive(true);
    client->set_tcp_nodelay(
        true);  // head and body are written apart, and would wait for each other
    client->set_follow_location(false);
    client->set_decompress(false);  // none is asked for, and a small one may grow without bound
    client->enable_server_certificate_verification(true);
    client->set_socket_options([this](socket_t socket) { connection.use(socket); });
    if (!login.user.empty()) client->set_basic_auth(login.user, login.password);
  }

  std::string resource(const char* parameter, const std::string& id) const {
    return endpoint.path + "/statements?" + parameter + "=" + id;
  }

  LrsAnswer answerTo(httplib::Request request) {
    std::string body;
    request.headers.insert(headers.begin(), headers.end());
    request.response_handler = [this](const httplib::Response&) {
      count.in_body = true;
      count.bytes = 0;
      return true;
    };
    request.content_receiver = [&](const char* bytes, std::size_t size, std::uint64_t,
                                   std::uint64_t) {
      count.too_long |= body.size() + size > kLongestAnswer;
      if (!count.too_long) body.append(bytes, size);
      return !count.too_long;
    };
    count = {};
    ExchangeWatch watch(connection, whole);
    const httplib::Result result = client->send(request);
    const bool too_slow = watch.end();
    LrsAnswer answer;
    if (count.too_long)
      answer.trouble = kTooLong;
    else if (too_slow)
      answer.trouble = kTooSlow;
    else if (!result)
      answer.trouble = inWords(result.error());
    else
      answer = answerOf(*result, std::move(body));
    return answer;
  }

  static LrsAnswer answerOf(const httplib::Response& response, std::string body) {
    return {response.status, response.get_header_value(kVersionHeader).rfind("1.", 0) == 0,
            std::move(body), ""};
  }

  /// As the address says, else the usual one.
  static int portOf(const Endpoint& e) {
    const std::size_t colon = e.origin.rfind(':'), bracket = e.origin.rfind(']');
    const bool stated = colon != std::string::npos && colon > e.origin.find("//") &&
                        (bracket == std::string::npos || colon > bracket) &&
                        colon + 1 < e.origin.size();
    if (stated) return std::stoi(e.origin.substr(colon + 1));
    return e.origin.starts_with("https") ? 443 : 80;
  }

  const Endpoint endpoint;
  const std::chrono::seconds whole;
  AnswerCount count;
  WatchedConnection connection;
  const std::unique_ptr<httplib::ClientImpl> client;
  const httplib::Headers headers{{kVersionHeader, kVersion}, {"Accept", "application/json"}};
};

LrsClient::LrsClient(const Endpoint& endpoint, const Login& login, const LrsTimes& times)
    : impl_(std::make_unique<Impl>(endpoint, login, times)) {}
LrsClient::~LrsClient() = default;

LrsAnswer LrsClient::put(const std::string& id, const std::string& statement) {
  httplib::Request request;
  request.method = "PUT";
  request.path = impl_->resource("statementId", id);
  request.body = statement;
  request.headers.emplace("Content-Type", "application/json");
  return impl_->answerTo(std::move(request));
}

LrsAnswer LrsClient::get(const std::string& id, bool voided) {
  httplib::Request request;
  request.method = "GET";
  request.path = impl_->resource(voided ? "voidedStatementId" : "statementId", id);
  return impl_->answerTo(std::move(request));
}

}  // namespace palpa::link

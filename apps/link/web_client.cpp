#include "apps/link/web_client.h"

#include <chrono>

#include "apps/link/bounded_client.h"
#include "apps/os/socket.h"

namespace palpa::link {
namespace {

constexpr char kVersionHeader[] = "X-Experience-API-Version";
// A body in pieces says the length of each: more bytes than it holds
constexpr std::size_t kLongestBytes = 2 * WebClient::kLongestAnswer;
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

struct WebClient::Impl {
  Impl(const Endpoint& e, const WebTimes& times)
      : whole(times.whole_s),
        given_up(times.given_up),
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
  }

  WebAnswer answerTo(const WebRequest& asked) {
    httplib::Request request;
    request.method = asked.method;
    request.path = asked.path;
    request.body = asked.body;
    if (!asked.content_type.empty()) request.headers.emplace("Content-Type", asked.content_type);
    for (const auto& [name, value] : asked.headers) request.headers.emplace(name, value);
    std::string body;
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
    ExchangeWatch watch(connection, whole, given_up);
    const httplib::Result result = client->send(request);
    const bool too_slow = watch.end();
    WebAnswer answer;
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

  static WebAnswer answerOf(const httplib::Response& response, std::string body) {
    return {response.status, response.get_header_value(kVersionHeader), std::move(body), ""};
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

  const std::chrono::seconds whole;
  const std::atomic<bool>* const given_up;
  AnswerCount count;
  WatchedConnection connection;
  const std::unique_ptr<httplib::ClientImpl> client;
};

WebClient::WebClient(const Endpoint& endpoint, const WebTimes& times)
    : impl_(std::make_unique<Impl>(endpoint, times)) {}
WebClient::~WebClient() = default;

void WebClient::login(const std::string& user, const std::string& password) {
  impl_->client->set_basic_auth(user, password);
}

WebAnswer WebClient::answerTo(const WebRequest& request) { return impl_->answerTo(request); }

}  // namespace palpa::link

#include "apps/console/web/web_server.h"

#include <algorithm>
#include <memory>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "apps/console/web/http_framing.h"
#include "apps/os/real_time.h"
#include "apps/os/socket.h"

namespace palpa::console {
namespace {

using Clock = DeadlineStream::Clock;
using namespace std::chrono_literals;
constexpr std::chrono::milliseconds kBodyWithin = 10s, kCrowdedBodyWithin = 2s,
                                    kAnswerWithin = 120s, kStalled = 10s, kStopAnswered = 100ms,
                                    kLinger = 500ms;
constexpr int kKnocking = 512, kRequestsAConnection = 1000;
constexpr std::size_t kLongestRequest = 128u << 10, kMostLater = 1000;

/// The request that this thread is at.
struct RequestState {
  std::string remote;
  DeadlineStream* stream = nullptr;
  GuardVerdict head;      ///< of its head as it came
  bool is_stop = false;   ///< on the thread for emergency stops
  bool admitted = false;  ///< framing and guard let it pass; its body is read then
  bool answered = false;
  bool noted = false;    ///< a refusal, in words
  bool nowhere = false;  ///< no such path
  bool closes = false;
};
thread_local RequestState turn;

const char* wordsFor(int status) {
  switch (status) {
    case 400:
      return "was not understood";
    case 403:
      return "a wrong token";
    case 404:
      return "no such path";
    case 414:
      return "a path too long";
    case 422:
      return "cannot be done as requested";
    case 500:
      return "went wrong";
    default:
      return "refused";
  }
}

void setSafeHeaders(const httplib::Request& request, httplib::Response& response) {
  const bool report =
      request.path.rfind("/api/pages/", 0) == 0 || request.path.find("/file/") != std::string::npos;
  for (const auto& [name, value] : safeHeaders()) {
    response.headers.erase(name);
    response.set_header(name, report && name == "Content-Security-Policy" ? kReportPolicy : value);
  }
}

/// Takes off, for a moment, what is still being sent: a socket closed with bytes unread takes the
/// answer with it.
void linger(os::Line& line) {
  const int socket = line.socket();
  line.endWriting();
  char bytes[4096];
  const auto until = Clock::now() + kLinger;
  for (std::size_t left = kLongestRequest; left > sizeof bytes && Clock::now() < until;
       left -= sizeof bytes) {
    if (!os::ready(socket, os::Wait::to_read, static_cast<int>(kLinger.count())) ||
        os::receiveSome(socket, bytes, sizeof bytes).value_or(0) == 0)
      return;
  }
}

}  // namespace

WebServer::WebServer(Guard& guard, Refusals& refusals, const os::TlsServer* tls)
    : guard_(guard),
      refusals_(refusals),
      lobby_({.request =
                  [this](std::unique_ptr<Caller> caller) {
                    if (threads_.take(caller)) return;
                    turnAway(*caller);
                    countAway();
                  },
              .may_stop =
                  [this](std::string_view head, const std::string& remote) {
                    return judgeHead(head).status == 200 && guard_.mayStop(askedIn(head, remote));
                  },
              .stop =
                  [this](std::unique_ptr<Caller> caller) {
                    if (threads_.takeStop(caller)) return;
                    turnAway(*caller);
                    countAway();
                  },
              .slow =
                  [this](const std::string& remote) {
                    noteLater(remote, "-", "-", 408, "a request was too slow or too long");
                  },
              .away = [this] { countAway(); },
              .line =
                  [tls](int socket) {
                    return tls ? tls->lineOver(socket) : std::make_unique<os::Line>(socket);
                  }}),
      threads_([this](std::unique_ptr<Caller> caller) { answer(std::move(caller)); },
               [this](std::unique_ptr<Caller> caller) { answerStop(std::move(caller)); }) {
  set_payload_max_length(kLongestBody);
  // Not the library's SO_REUSEPORT: another console would share the port, and its pages.
  set_socket_options([](socket_t socket) { os::reuseAddress(socket); });
  set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    return admit(request, response);
  });
  set_exception_handler(
      [](const httplib::Request&, httplib::Response& response, std::exception_ptr thrown) {
        try {
          std::rethrow_exception(std::move(thrown));
        } catch (const UsageError& e) {
          refuse(response, 422, e.what());
        } catch (const std::exception& e) {
          refuse(response, 500, e.what());
        }
      });
  set_error_handler([](const httplib::Request&, httplib::Response& response) {
    turn.nowhere = response.body.empty() && response.status == 404;
    if (response.body.empty())
      refuse(response, response.status,
             response.status == 404   ? "is not here"
             : response.status == 413 ? "is too long"
                                      : "was not understood");
  });
  set_post_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    finish(request, response);
  });
}

WebServer::~WebServer() {
  end();
  threads_.end();
  if (const socket_t listener = svr_sock_.exchange(-1); listener >= 0) os::closeSocket(listener);
}

void WebServer::serve() {
  const int listener = svr_sock_.load();
  os::widenBacklog(listener, kKnocking);
  os::neverWait(listener);
  lobby_.run(listener);
  threads_.end();
}

void WebServer::end() {
  ending_.store(true);
  lobby_.end();
}

bool WebServer::enterStream() {
  const std::lock_guard lock(streams_mutex_);
  int all = 0;
  for (const auto& [remote, count] : streams_) all += count;
  const auto own = streams_.find(turn.remote);
  if (all >= kMostStreams || (own != streams_.end() && own->second >= kMostStreamsOfOne))
    return false;
  ++streams_[turn.remote];
  turn.stream->answerWithin(std::chrono::milliseconds::max(), kStalled);
  return true;
}

void WebServer::leaveStream() {
  const std::lock_guard lock(streams_mutex_);
  if (const auto own = streams_.find(turn.remote); own != streams_.end() && --own->second <= 0)
    streams_.erase(own);
}

void WebServer::countAway() {
  const std::lock_guard lock(later_mutex_);
  ++away_;
}

void WebServer::noteLater(const std::string& remote, const std::string& method,
                          const std::string& path, int status, const std::string& words) {
  const std::lock_guard lock(later_mutex_);
  if (later_.size() < kMostLater) later_.push_back({remote, method, path, status, words});
}

void WebServer::noteTurnedAway() {
  std::vector<Later> later;
  std::size_t away = 0;
  {
    const std::lock_guard lock(later_mutex_);
    later.swap(later_);
    std::swap(away, away_);
  }
  for (const Later& one : later)
    refusals_.note(one.remote, one.method, one.path, one.status, one.words);
  if (away > 0)
    refusals_.note("-", "-", "-", 503, "too many connections (" + std::to_string(away) + ")");
}

/// Of an emergency stop later: it waits for no file.
void WebServer::note(const std::string& method, const std::string& path, int status,
                     const std::string& words) {
  if (turn.is_stop)
    noteLater(turn.remote, method, path, status, words);
  else
    refusals_.note(turn.remote, method, path, status, words);
}

httplib::Server::HandlerResponse WebServer::admit(const httplib::Request& request,
                                                  httplib::Response& response) {
  GuardVerdict verdict = turn.head;
  if (verdict.status == 200) verdict = judgeFraming(request);
  if (verdict.status == 200) verdict = guard_.judge(askedOf(request));
  turn.admitted = verdict.status == 200;
  if (turn.admitted) return HandlerResponse::Unhandled;
  turn.noted = true;
  note(request.method, request.path, verdict.status, verdict.words);
  refuse(response, verdict.status, verdict.words);
  return HandlerResponse::Handled;
}

/// Every answer passes here, also to what could not be read as a request.
void WebServer::finish(const httplib::Request& request, httplib::Response& response) {
  turn.answered = true;
  setSafeHeaders(request, response);
  const bool refused =
      response.status >= 400 && response.status != 409 && (response.status != 404 || turn.nowhere);
  if (refused && !turn.noted)
    note(request.method, request.path, response.status, wordsFor(response.status));
  turn.closes = response.status >= 400 &&
                (!turn.admitted || response.status == 400 || response.status == 413);
  if (!turn.closes) return;
  response.headers.erase("Keep-Alive");
  response.headers.erase("Connection");
  response.set_header("Connection", "close");
}

/// One request; true: another may come over this connection.
bool WebServer::process(DeadlineStream& stream, Caller& caller) {
  const auto whole = [](httplib::Request& request) {
    request.ranges.clear();  // parts are refused; the refusal is not an answer in parts either
    request.headers.erase("Accept-Encoding");  // packing costs more than a near network gains
  };
  bool closed = false;
  const bool last = ++caller.answered >= kRequestsAConnection;
  const bool processed = processRequest(stream, last, closed, whole);
  // The library has a bound of its own for a line: neither answered nor ended by the other side.
  if (stream.cut() || !(processed || turn.answered || stream.left())) {
    note("-", "-", 408, "a request was too slow or too long");
    return false;
  }
  return processed && !closed && !last && !ending();
}

void WebServer::answer(std::unique_ptr<Caller> caller) {
  const GuardVerdict head =
      judgeHead(std::string_view(caller->said).substr(0, endOfHead(caller->said)));
  DeadlineStream stream(*caller->line, std::exchange(caller->said, ""));
  stream.begin(Clock::now() + (threads_.crowded() ? kCrowdedBodyWithin : kBodyWithin),
               kLongestRequest);
  stream.answerWithin(kAnswerWithin, kStalled);
  turn = {.remote = caller->remote, .stream = &stream, .head = head};
  const bool more = process(stream, *caller);
  if (turn.closes) return linger(*caller->line);
  if (!more) return;
  caller->said = stream.rest();
  lobby_.comeBack(std::move(caller));
}

/// The same, without anything to wait for: all of it is here, and an answer that is not taken off
/// is none.
void WebServer::answerStop(std::unique_ptr<Caller> caller) {
  const GuardVerdict head =
      judgeHead(std::string_view(caller->said).substr(0, endOfHead(caller->said)));
  DeadlineStream stream(*caller->line, std::exchange(caller->said, ""));
  stream.begin(Clock::now() + kStopAnswered, 0);
  stream.answerWithin(std::chrono::milliseconds::max(), kStopAnswered);
  turn = {.remote = caller->remote, .stream = &stream, .head = head, .is_stop = true};
  if (!process(stream, *caller) || turn.closes) return;
  caller->said = stream.rest();
  lobby_.comeBack(std::move(caller));
}

const char* mediaTypeOf(const std::string& name) {
  constexpr std::pair<const char*, const char*> kTypes[] = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".svg", "image/svg+xml"},
      {".csv", "text/csv; charset=utf-8"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".pdf", "application/pdf"}};
  for (const auto& [ending, type] : kTypes)
    if (name.ends_with(ending)) return type;
  return "application/octet-stream";
}

std::size_t wholeNumber(const std::string& text, std::size_t otherwise) {
  constexpr std::size_t kDigits = 6;
  if (text.empty() || text.size() > kDigits ||
      !std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }))
    return otherwise;
  return std::stoul(text);
}

void refuse(httplib::Response& response, int status, const std::string& words) {
  answer(response, {{"error", words}}, status);
}

void answer(httplib::Response& response, const nlohmann::json& json, int status) {
  response.status = status;
  response.set_content(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
                       "application/json");
}

nlohmann::json bodyOf(const httplib::Request& request) {
  nlohmann::json body = parsedOrDiscarded(request.body);
  if (!body.is_object())
    throw UsageError("is not a JSON object", "what was sent", "Load the page again");
  return body;
}

}  // namespace palpa::console

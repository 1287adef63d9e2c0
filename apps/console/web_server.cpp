#include "apps/console/web_server.h"

#include <algorithm>
#include <memory>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "apps/console/http_framing.h"
#include "apps/os/real_time.h"
#include "apps/os/socket.h"

namespace palpa::console {
namespace {

using Clock = DeadlineStream::Clock;
constexpr std::chrono::milliseconds kRequestWithin{10'000}, kIdle{5'000};
constexpr std::chrono::milliseconds kCrowdedRequestWithin{2'000},
    kCrowdedIdle{250};  // where half the places are taken: who says nothing makes room
constexpr int kKnocking = 512;
constexpr std::size_t kLongestRequest = 128u << 10;
constexpr std::chrono::milliseconds kLinger{500};
constexpr int kRequestsAConnection = 1000, kThreadsToRefuse = 8;

/// A pool whose threads give way to the rest of the computer.
class LowPriorityPool final : public httplib::TaskQueue {
 public:
  LowPriorityPool() : pool_(WebServer::kMostConnections + kThreadsToRefuse) {}
  Enqueued enqueue(std::function<void()> work) override {
    return pool_.enqueue([work = std::move(work)] {
      thread_local const bool gave = (os::giveWay(), true);
      (void)gave;
      work();
    });
  }
  void shutdown() override { pool_.shutdown(); }

 private:
  httplib::ThreadPool pool_;
};

/// The request that this thread is at.
struct RequestState {
  std::string remote;
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
void linger(int socket) {
  os::endWriting(socket);
  char bytes[4096];
  const auto until = Clock::now() + kLinger;
  for (std::size_t left = kLongestRequest; left > sizeof bytes && Clock::now() < until;
       left -= sizeof bytes) {
    if (!os::ready(socket, os::Wait::to_read, static_cast<int>(kLinger.count())) ||
        os::receiveSome(socket, bytes, sizeof bytes).value_or(0) == 0)
      return;
  }
}

GuardedRequest askedOf(const httplib::Request& r) {
  return {r.remote_addr,
          r.method,
          r.path,
          r.get_header_value("Host"),
          r.get_header_value("Origin"),
          r.get_header_value("Sec-Fetch-Site"),
          r.get_header_value("Content-Type"),
          r.get_header_value("Cookie"),
          r.get_header_value("X-Palpa-Page"),
          r.get_header_value("X-Palpa-Write")};
}

constexpr char kFull[] =
    "HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\nConnection: close\r\nRetry-After: "
    "5\r\n\r\n";

}  // namespace

WebServer::WebServer(Guard& guard, Refusals& refusals) : guard_(guard), refusals_(refusals) {
  new_task_queue = [] { return new LowPriorityPool; };
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

void WebServer::end() {
  ending_.store(true);
  stop();
}

void WebServer::widen() { os::widenBacklog(svr_sock_.load(), kKnocking); }

httplib::Server::HandlerResponse WebServer::admit(const httplib::Request& request,
                                                  httplib::Response& response) {
  GuardVerdict verdict = judgeFraming(request);
  if (verdict.status == 200) verdict = guard_.judge(askedOf(request));
  turn.admitted = verdict.status == 200;
  if (turn.admitted) return HandlerResponse::Unhandled;
  turn.noted = true;
  refusals_.note(request.remote_addr, request.method, request.path, verdict.status, verdict.words);
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
    refusals_.note(turn.remote, request.method, request.path, response.status,
                   wordsFor(response.status));
  turn.closes = response.status >= 400 &&
                (!turn.admitted || response.status == 400 || response.status == 413);
  if (!turn.closes) return;
  response.headers.erase("Keep-Alive");
  response.headers.erase("Connection");
  response.set_header("Connection", "close");
}

bool WebServer::process_and_close_socket(socket_t socket) {
  if (connections_.fetch_add(1) < kMostConnections) {
    DeadlineStream stream(socket);
    serve(stream);
  } else {
    os::sendSome(socket, kFull, sizeof kFull - 1);
    refusals_.note("-", "-", "-", 503, "too many connections");
  }
  connections_.fetch_sub(1);
  os::endBoth(socket);
  os::closeSocket(socket);
  return true;
}

void WebServer::serve(DeadlineStream& stream) {
  for (int count = 1; count <= kRequestsAConnection && !ending(); ++count) {
    if (!stream.waits(crowded() ? kCrowdedIdle : kIdle)) return;
    stream.begin(Clock::now() + (crowded() ? kCrowdedRequestWithin : kRequestWithin),
                 kLongestRequest);
    bool closed = false;
    turn = {.remote = stream.remote()};
    const auto whole = [](httplib::Request& request) {
      request.ranges.clear();  // parts are refused; the refusal is not an answer in parts either
      request.headers.erase("Accept-Encoding");  // packing costs more than a near network gains
    };
    const bool processed = processRequest(stream, count == kRequestsAConnection, closed, whole);
    // The library has a bound of its own for a line: neither answered nor ended by the other side.
    if (stream.cut() || !(processed || turn.answered || stream.left()))
      return refusals_.note(turn.remote, "-", "-", 408, "a request was too slow or too long");
    if (!processed || closed) return;
    if (turn.closes) return linger(stream.socket());
  }
}

const char* mediaTypeOf(const std::string& name) {
  constexpr std::pair<const char*, const char*> kTypes[] = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".svg", "image/svg+xml"},
      {".csv", "text/csv; charset=utf-8"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"}};
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

#include "apps/console/web_server.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <memory>

#include "anatomy/geometry/error.h"
#include "apps/console/deadline_stream.h"
#include "apps/live/local_socket.h"

namespace palpa::console {
namespace {

using Clock = DeadlineStream::Clock;
constexpr std::chrono::seconds kRequestWithin{10}, kIdle{5};
constexpr std::size_t kLongestBody = 64u << 10, kLongestRequest = 128u << 10;
constexpr int kRequestsAConnection = 1000, kThreadsToRefuse = 8;

/// A pool whose threads give way to the rest of the computer.
class LowPriorityPool final : public httplib::TaskQueue {
 public:
  LowPriorityPool() : pool_(WebServer::kMostConnections + kThreadsToRefuse) {}
  void enqueue(std::function<void()> work) override {
    pool_.enqueue([work = std::move(work)] {
      thread_local const bool gave = (live::giveWay(), true);
      (void)gave;
      work();
    });
  }
  void shutdown() override { pool_.shutdown(); }

 private:
  httplib::ThreadPool pool_;
};

Asked askedOf(const httplib::Request& r) {
  return {r.remote_addr, r.method, r.path, r.get_header_value("Host"), r.get_header_value("Origin"), r.get_header_value("Sec-Fetch-Site"), r.get_header_value("Content-Type"), r.get_header_value("Cookie"),
          r.get_header_value("X-Palpa-Page"), r.get_header_value("X-Palpa-Write")};
}

constexpr char kFull[] = "HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\nConnection: close\r\nRetry-After: 5\r\n\r\n";

}  // namespace

WebServer::WebServer(Guard& guard, Refusals& refusals) : guard_(guard), refusals_(refusals) {
  new_task_queue = [] { return new LowPriorityPool; };
  set_payload_max_length(kLongestBody);
  set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) { return admit(request, response); });
  set_exception_handler([](const httplib::Request&, httplib::Response& response, std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const UsageError& e) {
      refuse(response, 422, e.what());
    } catch (const std::exception& e) {
      refuse(response, 500, e.what());
    }
  });
  set_error_handler([](const httplib::Request&, httplib::Response& response) {
    if (response.body.empty()) refuse(response, response.status, response.status == 404 ? "is not here" : response.status == 413 ? "is too long" : "was not understood");
  });
}

void WebServer::end() {
  ending_.store(true);
  stop();
}

httplib::Server::HandlerResponse WebServer::admit(const httplib::Request& request, httplib::Response& response) {
  const bool report = request.path.rfind("/api/pages/", 0) == 0 || request.path.find("/file/") != std::string::npos;
  for (const auto& [name, value] : safeHeaders()) response.set_header(name, report && name == "Content-Security-Policy" ? kReportPolicy : value);
  const Verdict verdict = guard_.judge(askedOf(request));
  if (verdict.status == 200) return HandlerResponse::Unhandled;
  refusals_.note(request.remote_addr, request.method, request.path, verdict.status, verdict.words);
  refuse(response, verdict.status, verdict.words);
  return HandlerResponse::Handled;
}

bool WebServer::process_and_close_socket(socket_t socket) {
  if (connections_.fetch_add(1) < kMostConnections) {
    DeadlineStream stream(socket);
    serve(stream);
    if (stream.cut()) refusals_.note(stream.remote(), "-", "-", 408, "a request was too slow or too long");
  } else {
    [[maybe_unused]] const ssize_t sent = ::send(socket, kFull, sizeof kFull - 1, MSG_NOSIGNAL | MSG_DONTWAIT);
    refusals_.note("-", "-", "-", 503, "too many connections");
  }
  connections_.fetch_sub(1);
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  return true;
}

void WebServer::serve(DeadlineStream& stream) {
  for (int count = 1; count <= kRequestsAConnection && !ending(); ++count) {
    if (!stream.waits(kIdle)) return;
    stream.begin(Clock::now() + kRequestWithin, kLongestRequest);
    bool closed = false;
    if (!process_request(stream, count == kRequestsAConnection, closed, nullptr) || closed || stream.cut()) return;
  }
}

const char* mediaTypeOf(const std::string& name) {
  constexpr std::pair<const char*, const char*> kTypes[] = {{".html", "text/html; charset=utf-8"}, {".js", "text/javascript; charset=utf-8"}, {".css", "text/css; charset=utf-8"}, {".svg", "image/svg+xml"},
                                                            {".csv", "text/csv; charset=utf-8"}, {".png", "image/png"}, {".jpg", "image/jpeg"}};
  for (const auto& [ending, type] : kTypes)
    if (name.ends_with(ending)) return type;
  return "application/octet-stream";
}

std::size_t wholeNumber(const std::string& text, std::size_t otherwise) {
  constexpr std::size_t kDigits = 6;
  if (text.empty() || text.size() > kDigits || !std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; })) return otherwise;
  return std::stoul(text);
}

void refuse(httplib::Response& response, int status, const std::string& words) { answer(response, {{"error", words}}, status); }

void answer(httplib::Response& response, const nlohmann::json& json, int status) {
  response.status = status;
  response.set_content(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), "application/json");
}

nlohmann::json bodyOf(const httplib::Request& request) {
  nlohmann::json body = nlohmann::json::parse(request.body, nullptr, false);
  if (!body.is_object()) throw UsageError("is no JSON object", "what was sent", "Load the page again");
  return body;
}

}  // namespace palpa::console

#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/console/web/guard.h"
#include "apps/console/web/httplib_server.h"
#include "apps/console/web/lobby.h"
#include "apps/console/web/request_threads.h"
#include "apps/os/tls/tls_line.h"

namespace palpa::console {

/// The HTTP server: limits on connections, sizes and time before a request is looked at; framing
/// and guard before its body is read; safe headers on every answer. What is refused is noted, and
/// ends its connection: what may be left of its body is no next request. Its threads give way to
/// all others, but for the lobby and the one for emergency stops, which wait for no file either.
class WebServer final : public HttplibServer {
 public:
  /// `tls`: connections are encrypted; it must outlive the server.
  WebServer(Guard& guard, Refusals& refusals, const os::TlsServer* tls = nullptr);
  ~WebServer() override;

  /// A stream (events, pictures) is let in: at most kMostStreams at once, kMostStreamsOfOne of one
  /// address. Within a request; until `leaveStream` within the same.
  bool enterStream();
  void leaveStream();
  /// The server is ending: streams shall.
  bool ending() const { return ending_.load(); }
  /// Once it is bound: answers until `end`; on the caller's thread.
  void serve();
  void end();
  /// Writes down what was turned away since; now and then.
  void noteTurnedAway();

  static constexpr int kMostStreams = 24, kMostStreamsOfOne = 12;

 private:
  void answer(std::unique_ptr<Caller> caller);
  void answerStop(std::unique_ptr<Caller> caller);
  bool process(class DeadlineStream& stream, Caller& caller);
  void finish(const httplib::Request& request, httplib::Response& response);
  HandlerResponse admit(const httplib::Request& request, httplib::Response& response);
  void note(const std::string& method, const std::string& path, int status,
            const std::string& words);
  void countAway();
  void noteLater(const std::string& remote, const std::string& method, const std::string& path,
                 int status, const std::string& words);

  Guard& guard_;
  Refusals& refusals_;
  std::mutex streams_mutex_;
  std::map<std::string, int> streams_;  ///< of each address
  std::atomic<bool> ending_{false};
  struct Later {
    std::string remote, method, path;
    int status = 0;
    std::string words;
  };
  std::mutex later_mutex_;
  std::vector<Later> later_;  ///< to be noted by a thread that may wait for a file
  std::size_t away_ = 0;      ///< how many had to go
  Lobby lobby_;
  RequestThreads threads_;  ///< last: they use the rest
};

/// Of a file, by its ending.
const char* mediaTypeOf(const std::string& name);
/// A whole number that a header or path holds; `otherwise` for what is none, or beyond six digits.
std::size_t wholeNumber(const std::string& text, std::size_t otherwise);

/// {"error": words} with a status.
void refuse(httplib::Response& response, int status, const std::string& words);
void answer(httplib::Response& response, const nlohmann::json& json, int status = 200);
/// The body as a JSON object; throws UsageError where it is none.
nlohmann::json bodyOf(const httplib::Request& request);

}  // namespace palpa::console

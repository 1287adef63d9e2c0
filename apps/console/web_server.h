#pragma once

#include <atomic>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/console/guard.h"
#include "apps/console/httplib_server.h"

namespace palpa::console {

/// The HTTP server: limits on connections, sizes and time before a request is looked at; framing
/// and guard before its body is read; safe headers on every answer. What is refused is noted, and
/// ends its connection: what may be left of its body is no next request. Its threads give way to
/// all others.
class WebServer final : public HttplibServer {
 public:
  WebServer(Guard& guard, Refusals& refusals);

  /// A stream (events, pictures) is let in: at most kMostStreams at once.
  bool enterStream() { return streams_.fetch_add(1) < kMostStreams || (leaveStream(), false); }
  void leaveStream() { streams_.fetch_sub(1); }
  /// The server is ending: streams shall.
  bool ending() const { return ending_.load(); }
  void end();
  /// Once it is bound: many may knock at once, and are told to wait rather than left before the
  /// door.
  void widen();

  static constexpr int kMostConnections = 96, kMostStreams = 24;

 private:
  bool process_and_close_socket(socket_t socket) override;
  void serve(class DeadlineStream& stream);
  void finish(const httplib::Request& request, httplib::Response& response);
  bool crowded() const { return connections_.load() > kMostConnections / 2; }
  HandlerResponse admit(const httplib::Request& request, httplib::Response& response);

  Guard& guard_;
  Refusals& refusals_;
  std::atomic<int> connections_{0}, streams_{0};
  std::atomic<bool> ending_{false};
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

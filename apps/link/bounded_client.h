#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include <httplib.h>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "apps/runtime/clock.h"
#undef _res  // a macro of <resolv.h>, a name in Eigen

namespace palpa::link {

/// How much of an answer may come: of its first line, of its head with that, of its body. The
/// library reads a line of any length, and takes long ones apart by means that need as much stack.
struct AnswerBounds {
  std::size_t first_line = 1u << 10, head = 64u << 10, body = 1u << 20;
};

/// What an answer has taken of its bounds.
struct AnswerCount {
  bool in_body = false;  ///< its head has ended
  bool too_long = false;
  std::size_t bytes = 0;  ///< of the part at hand
  bool line_ended = false;
};

/// The library's client for `host`, each of whose answers ends where it goes beyond `bounds`:
/// `count` says so then. Both outlive it; `count` is reset for each request, and told when the head
/// has ended.
std::unique_ptr<httplib::ClientImpl> boundedClient(const std::string& host, int port, bool tls,
                                                   const AnswerBounds& bounds, AnswerCount& count);

/// The connection that an HTTP client uses at the moment, on a descriptor of our own: what the
/// library closes meanwhile may be another's the next moment. Any thread.
class WatchedConnection {
 public:
  WatchedConnection() = default;
  ~WatchedConnection();
  WatchedConnection(const WatchedConnection&) = delete;
  WatchedConnection& operator=(const WatchedConnection&) = delete;

  void use(int socket);  ///< the client has opened this one
  void cut();            ///< whoever waits for it sees its end

 private:
  void drop();
  std::mutex mutex_;
  int shared_ = -1;
};

/// One request and its answer, from connecting on, watched from a thread beside it and cut where it
/// lasts too long or is given up, whatever it is at: the library bounds a pause between two bytes,
/// not the whole.
class ExchangeWatch {
 public:
  ExchangeWatch(WatchedConnection& connection, std::chrono::seconds whole,
                const std::atomic<bool>* given_up = nullptr);
  ~ExchangeWatch() { end(); }
  ExchangeWatch(const ExchangeWatch&) = delete;
  ExchangeWatch& operator=(const ExchangeWatch&) = delete;
  bool end();  ///< true: it was cut

 private:
  void watch();

  WatchedConnection& connection_;
  const runtime::ServingClock::time_point until_;
  const std::atomic<bool>* const given_up_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false, cut_ = false;
  std::thread thread_;
};

}  // namespace palpa::link

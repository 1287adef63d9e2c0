#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "apps/runtime/clock.h"

namespace palpa::link {

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
/// lasts too long, whatever it is at: the library bounds a pause between two bytes, not the whole.
class ExchangeWatch {
 public:
  ExchangeWatch(WatchedConnection& connection, std::chrono::seconds whole);
  ~ExchangeWatch() { end(); }
  ExchangeWatch(const ExchangeWatch&) = delete;
  ExchangeWatch& operator=(const ExchangeWatch&) = delete;
  bool end();  ///< true: it was cut

 private:
  void watch();

  WatchedConnection& connection_;
  const runtime::ServingClock::time_point until_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false, cut_ = false;
  std::thread thread_;
};

}  // namespace palpa::link

#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
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

  void use(int socket);          ///< the client has opened this one
  void beginExchange();          ///< what comes from here on is counted
  std::uint64_t received();      ///< bytes since
  void cut();                    ///< whoever waits for it sees its end

 private:
  void drop();
  std::mutex mutex_;
  int shared_ = -1;
  std::uint64_t before_ = 0;
};

/// One request and its answer, watched from a thread beside it, and cut where it lasts too long or
/// brings too much, wherever in the answer that is: the library bounds a pause between two bytes,
/// and neither of these.
class ExchangeWatch {
 public:
  enum class Cut { no, too_slow, too_much };
  ExchangeWatch(WatchedConnection& connection, std::chrono::seconds whole, std::uint64_t most);
  ~ExchangeWatch() { end(); }
  ExchangeWatch(const ExchangeWatch&) = delete;
  ExchangeWatch& operator=(const ExchangeWatch&) = delete;
  Cut end();

 private:
  void watch();

  WatchedConnection& connection_;
  const runtime::ServingClock::time_point until_;
  const std::uint64_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  Cut cut_ = Cut::no;
  std::thread thread_;
};

}  // namespace palpa::link

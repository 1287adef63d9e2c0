#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/os/socket.h"
#include "apps/runtime/clock.h"

namespace palpa::console {

/// A connection between two answers: where it comes from, and what it has said of its next request.
struct Caller {
  explicit Caller(std::unique_ptr<os::Line> from);
  ~Caller();  ///< ends the connection
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;

  const int socket;
  std::unique_ptr<os::Line> line;           ///< over that
  std::string remote;                       ///< its address in figures
  std::string said;                         ///< bytes of its next request
  int answered = 0;                         ///< requests
  runtime::ServingClock::time_point since;  ///< when it came, came back, or began to speak
};

/// What has no further place is told so.
void turnAway(const Caller& caller);

/// Where connections wait until the head of a request is complete: one thread for all of them, so
/// that whoever is silent or slow keeps no thread from others. At most kMost wait, kMostOfOne of
/// one address; where more come, the one that has waited longest makes room (of the same address
/// where that has its share, else of the address that has most). So nobody's silence keeps a page
/// out, nor an emergency stop.
class Lobby {
 public:
  static constexpr std::size_t kMost = 96, kMostOfOne = 24;
  struct Ways {
    std::function<void(std::unique_ptr<Caller>)> request;  ///< its head is here, or as good as
    /// Whether a whole head may stop a session: else it goes the way of all requests, and is
    /// refused there. Waits for nothing.
    std::function<bool(std::string_view head, const std::string& remote)> may_stop;
    std::function<void(std::unique_ptr<Caller>)> stop;    ///< an emergency stop that may, complete
    std::function<void(const std::string& remote)> slow;  ///< began a request, and did not end it
    std::function<void()> away;                           ///< one had to make room
    /// How a connection is spoken over; as it is, unless said otherwise
    std::function<std::unique_ptr<os::Line>(int socket)> line = [](int socket) {
      return std::make_unique<os::Line>(socket);
    };
  };
  explicit Lobby(Ways ways) : ways_(std::move(ways)) {}

  /// Lets in whoever knocks at `listener` until `end`. On the caller's thread; waits for nothing
  /// but them.
  void run(int listener);
  /// Waits for its next request; dropped after the end. Any thread.
  void comeBack(std::unique_ptr<Caller> caller);
  void end();  ///< any thread

 private:
  using Clock = runtime::ServingClock;
  void wait(int listener);
  void letIn(int listener);
  std::unique_ptr<os::Line> lineOver(int socket) const;
  void takeBack();
  void makeRoom();
  void hearAll();
  bool hear(std::unique_ptr<Caller>& caller);
  std::optional<std::size_t> stopLengthOf(const Caller& caller) const;
  bool isOver(const Caller& caller) const;
  bool crowded() const { return waiting_.size() > kMost / 2; }

  const Ways ways_;
  os::WakeUp wake_;
  std::vector<std::unique_ptr<Caller>> waiting_;  ///< who came first is first
  std::mutex mutex_;
  std::vector<std::unique_ptr<Caller>> back_;  ///< came back since
  std::atomic<bool> ending_{false};
};

}  // namespace palpa::console

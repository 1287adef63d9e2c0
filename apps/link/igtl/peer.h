#pragma once

#include <deque>
#include <map>

#include "apps/link/igtl/message_stream.h"
#include "apps/link/igtl/tcp_socket.h"

namespace palpa::igt {

/// One who listens to a server. What is to be sent waits here, bounded: of a state (a transform, a
/// force) the newest replaces the one that is not on its way yet, of events the oldest
/// `kMostEvents` give way. So one who reads slowly, or not at all, costs neither time nor memory.
class Peer {
 public:
  static constexpr std::size_t kMostEvents = 256;
  Peer(TcpSocket socket, std::int64_t now_ns) : socket_(std::move(socket)), moved_ns_(now_ns) {}

  void state(const std::string& key, Bytes message) { states_[key] = std::move(message); }
  void event(Bytes message);
  /// Sends as much as the connection takes.
  void flush(std::int64_t now_ns);
  /// What was asked since the last call.
  std::vector<Message> requests();

  /// Still there, speaking OpenIGTLink, and has taken something within the last `kPatience_ns` if
  /// something waits.
  static constexpr std::int64_t kPatience_ns = 30'000'000'000;
  bool alive(std::int64_t now_ns) const {
    return socket_.open() && !stream_.broken() && (idle() || now_ns - moved_ns_ < kPatience_ns);
  }

  struct Tracking {
    bool on = false;
    std::int64_t period_ns = 0, next_ns = 0;
    std::string coordinates;
  };
  Tracking tracking;  ///< TDATA, where it was asked for
  std::uint64_t lostEvents() const { return lost_events_; }

 private:
  bool idle() const { return sent_ == sending_.size() && events_.empty() && states_.empty(); }
  bool takeNext();

  TcpSocket socket_;
  MessageStream stream_;
  Bytes sending_;         ///< the message on its way
  std::size_t sent_ = 0;  ///< bytes of it
  std::deque<Bytes> events_;
  std::map<std::string, Bytes> states_;
  std::int64_t moved_ns_;  ///< when the connection last took something, or nothing waited
  std::uint64_t lost_events_ = 0;
};

}  // namespace palpa::igt

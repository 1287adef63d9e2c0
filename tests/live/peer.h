#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <functional>
#include <string>
#include <vector>

#include "apps/live/wire.h"
#include "apps/os/local_socket.h"
#include "apps/runtime/clock.h"

namespace palpa::live {

/// Until `seen` is true, for at most half a minute.
inline bool eventually(const std::function<bool()>& seen) {
  const auto until = runtime::ServingClock::now() + std::chrono::seconds(30);
  while (!seen()) {
    if (runtime::ServingClock::now() > until) return false;
    runtime::rest(std::chrono::milliseconds(5));
  }
  return true;
}

/// Whoever looks on at a session.
class Peer {
 public:
  explicit Peer(const std::string& path) {
    eventually([&] {
      return (socket_ = os::connectTo(path)) >= 0 || errno != EAGAIN;
    });  // EAGAIN: the kernel's queue of callers is full
  }
  ~Peer() { leave(); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  bool connected() const { return socket_ >= 0; }
  void leave() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }
  /// What the socket takes now, at most all of it; -1: it is broken.
  ssize_t send(const std::string& bytes) {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  }
  /// All of it; false: the other end has gone.
  bool sendAll(const std::string& bytes) {
    for (std::size_t sent = 0; sent < bytes.size();) {
      pollfd one{socket_, POLLOUT, 0};
      if (::poll(&one, 1, 30'000) != 1) return false;
      const ssize_t count = send(bytes.substr(sent));
      if (count < 0 && errno != EAGAIN) return false;
      if (count > 0) sent += static_cast<std::size_t>(count);
    }
    return true;
  }
  /// Reads what is there; false: the other end has gone.
  bool read() {
    char bytes[65536];
    pollfd one{socket_, POLLIN, 0};
    if (::poll(&one, 1, 10) != 1) return true;
    const ssize_t count = ::recv(socket_, bytes, sizeof bytes, MSG_DONTWAIT);
    if (count <= 0) return count < 0 && errno == EAGAIN;
    decoder_.feed(bytes, static_cast<std::size_t>(count));
    while (auto frame = decoder_.next()) {
      if (frame->kind == FrameKind::known) known = frame->body;
      if (frame->kind == FrameKind::entry) entries.push_back(std::move(frame->body));
      if (frame->kind == FrameKind::picture) pictures.push_back(std::move(frame->body));
    }
    return true;
  }
  bool isLeft() {
    return eventually([this] { return !read(); });
  }
  bool getsEntries(std::size_t count) {
    return eventually([&] { return entries.size() >= count || !read(); }) &&
           entries.size() >= count;
  }

  std::string known;
  std::vector<std::string> entries, pictures;

 private:
  int socket_ = -1;
  FrameDecoder decoder_;
};

}  // namespace palpa::live

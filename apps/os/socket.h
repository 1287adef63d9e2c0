#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

/// What is asked of any open socket, TCP or local. A socket is its descriptor here; whoever made it
/// closes it.
namespace palpa::os {

enum class Wait { to_read, to_write };
/// It takes or gives bytes, or has failed, after at most `wait_ms`.
bool ready(int socket, Wait wait, int wait_ms);
/// It takes bytes, and the other side is there to read them: false as soon as it is gone.
bool readerTakes(int socket, int wait_ms);

struct WatchedSocket {
  int socket = -1;
  bool to_write = false;  ///< to read always
};
/// Until one of them is ready, at most `wait_ms`.
void waitForAny(std::span<const WatchedSocket> all, int wait_ms);

/// Bytes sent now; 0: it would have to wait; nothing: the other side is gone. Never waits.
std::optional<std::size_t> sendSome(int socket, const void* bytes, std::size_t size);
/// The same for bytes that are there to be read.
std::optional<std::size_t> receiveSome(int socket, void* bytes, std::size_t size);

/// One of those who knock at a listening socket; it never waits, and no child inherits it. -1:
/// nobody does, or not any more; kNoMoreSockets: this process, or the system, has no more to give.
int acceptOne(int listener);
inline constexpr int kNoMoreSockets = -2;

struct Address {
  std::string ip;  ///< in figures; empty for a local socket
  int port = -1;
};
std::optional<Address> peerOf(int socket);
std::optional<Address> ownOf(int socket);

void endWriting(int socket);
void endBoth(int socket);
/// Since bytes came last, of a TCP socket; nothing: it is none.
std::optional<std::chrono::milliseconds> silentSince(int socket);
void closeSocket(int socket);

/// An address whose last connections are not quite over may be listened at again.
void reuseAddress(int socket);
/// So many may knock at once at one that listens.
void widenBacklog(int listener, int most);
/// Accepting, sending and receiving never wait.
void neverWait(int socket);
/// Of a TCP connection: small messages leave at once, and do not wait for each other.
void sendAtOnce(int socket);
/// A connection that breaks while something is sent ends no program from now on: for libraries that
/// send by themselves. What is sent from here never does.
void surviveBrokenConnections();
/// A second descriptor of the same connection, to be closed apart; -1: there is none left.
int sharedSocket(int socket);

/// What is said over a socket, which stays its owner's: as it is, or in the words of a class that
/// derives from this one (tls/tls_line.h). Nothing here waits.
class Line {
 public:
  explicit Line(int socket) : socket_(socket) {}
  virtual ~Line() = default;
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  int socket() const { return socket_; }
  /// As `os::sendSome` and `os::receiveSome`. What could not be sent is offered again, unchanged.
  virtual std::optional<std::size_t> sendSome(const void* bytes, std::size_t size) {
    return os::sendSome(socket_, bytes, size);
  }
  virtual std::optional<std::size_t> receiveSome(void* bytes, std::size_t size) {
    return os::receiveSome(socket_, bytes, size);
  }
  /// Bytes are here to be received although the socket gives none.
  virtual bool holdsMore() const { return false; }
  /// The other side has begun to say who it is, and the two do not understand each other yet.
  virtual bool greets() const { return false; }
  /// Nothing more will be said; it may still be listened to.
  virtual void endWriting() { os::endWriting(socket_); }

 private:
  const int socket_;
};

/// Wakes one thread that waits in `waitForAny` for its `descriptor`, from any other. Throws Error
/// where the system gives none.
class WakeUp {
 public:
  WakeUp();
  ~WakeUp();
  WakeUp(const WakeUp&) = delete;
  WakeUp& operator=(const WakeUp&) = delete;
  int descriptor() const { return descriptor_; }
  void wake() noexcept;
  void taken() noexcept;  ///< by the thread that was woken: it may wait again

 private:
  int descriptor_ = -1;
};

/// An IPv4 address in figures that this computer alone can reach. (A name that begins with 127. may
/// be anybody's.)
bool isLoopbackAddress(const std::string& ipv4);

}  // namespace palpa::os

#pragma once

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
/// Sends as the socket is set: one that waits does so, up to its own time limit. Nothing: none of
/// it could be sent.
std::optional<std::size_t> sendWaiting(int socket, const void* bytes, std::size_t size);

/// One of those who knock at a listening socket; it never waits, and no child inherits it. -1:
/// nobody does.
int acceptOne(int listener);

struct Address {
  std::string ip;  ///< in figures; empty for a local socket
  int port = -1;
};
std::optional<Address> peerOf(int socket);
std::optional<Address> ownOf(int socket);

void endWriting(int socket);
void endBoth(int socket);
void closeSocket(int socket);

/// An address whose last connections are not quite over may be listened at again.
void reuseAddress(int socket);
/// So many may knock at once at one that listens.
void widenBacklog(int listener, int most);

/// An IPv4 address in figures that this computer alone can reach. (A name that begins with 127. may
/// be anybody's.)
bool isLoopbackAddress(const std::string& ipv4);

}  // namespace palpa::os

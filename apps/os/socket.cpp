#include "apps/os/socket.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"

namespace palpa::os {
namespace {

/// Of send and recv.
std::optional<std::size_t> countOf(ssize_t result) {
  if (result >= 0) return static_cast<std::size_t>(result);
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return 0;
  return std::nullopt;
}

template <typename Ask>
std::optional<Address> addressFrom(Ask ask, int socket) {
  sockaddr_storage from{};
  socklen_t size = sizeof from;
  if (ask(socket, reinterpret_cast<sockaddr*>(&from), &size) != 0) return std::nullopt;
  char text[INET6_ADDRSTRLEN] = "";
  Address address;
  if (from.ss_family == AF_INET) {
    const auto& v4 = reinterpret_cast<const sockaddr_in&>(from);
    ::inet_ntop(AF_INET, &v4.sin_addr, text, sizeof text);
    address.port = ntohs(v4.sin_port);
  } else if (from.ss_family == AF_INET6) {
    const auto& v6 = reinterpret_cast<const sockaddr_in6&>(from);
    ::inet_ntop(AF_INET6, &v6.sin6_addr, text, sizeof text);
    address.port = ntohs(v6.sin6_port);
  }
  address.ip = text;
  return address;
}

}  // namespace

bool ready(int socket, Wait wait, int wait_ms) {
  pollfd one{socket, wait == Wait::to_read ? short{POLLIN} : short{POLLOUT}, 0};
  return ::poll(&one, 1, wait_ms) > 0;
}

bool readerTakes(int socket, int wait_ms) {
  pollfd one{socket, POLLOUT | POLLRDHUP, 0};
  return ::poll(&one, 1, wait_ms) == 1 && !(one.revents & (POLLERR | POLLHUP | POLLRDHUP)) &&
         (one.revents & POLLOUT);
}

void waitForAny(std::span<const WatchedSocket> all, int wait_ms) {
  std::vector<pollfd> polled;
  for (const WatchedSocket& one : all)
    polled.push_back({one.socket, one.to_write ? short{POLLIN | POLLOUT} : short{POLLIN}, 0});
  ::poll(polled.data(), polled.size(), wait_ms);
}

std::optional<std::size_t> sendSome(int socket, const void* bytes, std::size_t size) {
  return countOf(::send(socket, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT));
}

std::optional<std::size_t> receiveSome(int socket, void* bytes, std::size_t size) {
  const ssize_t result = ::recv(socket, bytes, size, MSG_DONTWAIT);
  return result == 0 ? std::nullopt : countOf(result);
}

int acceptOne(int listener) {
  const int socket = ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (socket >= 0) return socket;
  const bool none_left = errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM;
  return none_left ? kNoMoreSockets : -1;
}

std::optional<Address> peerOf(int socket) { return addressFrom(::getpeername, socket); }

std::optional<Address> ownOf(int socket) { return addressFrom(::getsockname, socket); }

void endWriting(int socket) { ::shutdown(socket, SHUT_WR); }

void endBoth(int socket) { ::shutdown(socket, SHUT_RDWR); }

std::optional<std::chrono::milliseconds> silentSince(int socket) {
  tcp_info facts{};
  socklen_t size = sizeof facts;
  if (::getsockopt(socket, IPPROTO_TCP, TCP_INFO, &facts, &size) != 0) return std::nullopt;
  return std::chrono::milliseconds(facts.tcpi_last_data_recv);
}

void closeSocket(int socket) { ::close(socket); }

void reuseAddress(int socket) {
  const int on = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
}

void widenBacklog(int listener, int most) { ::listen(listener, most); }

void neverWait(int socket) {
  if (const int flags = ::fcntl(socket, F_GETFL); flags >= 0)
    ::fcntl(socket, F_SETFL, flags | O_NONBLOCK);
}

void sendAtOnce(int socket) {
  const int on = 1;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

void surviveBrokenConnections() { ::signal(SIGPIPE, SIG_IGN); }

int sharedSocket(int socket) { return ::fcntl(socket, F_DUPFD_CLOEXEC, 0); }

WakeUp::WakeUp() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (descriptor_ < 0)
    throw Error("gives no further file descriptor (" + fileTrouble(errno).why + ")",
                "this computer", "End other programs, or raise the limit (ulimit -n)");
}

WakeUp::~WakeUp() { ::close(descriptor_); }

void WakeUp::wake() noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(descriptor_, &one, sizeof one);
}

void WakeUp::taken() noexcept {
  std::uint64_t count = 0;
  [[maybe_unused]] const ssize_t taken = ::read(descriptor_, &count, sizeof count);
}

bool isLoopbackAddress(const std::string& ipv4) {
  in_addr v4{};
  return ::inet_pton(AF_INET, ipv4.c_str(), &v4) == 1 && ntohl(v4.s_addr) >> 24 == 127;
}

}  // namespace palpa::os

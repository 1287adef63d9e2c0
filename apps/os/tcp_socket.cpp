#include "apps/os/tcp_socket.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <optional>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/socket.h"

namespace palpa::os {
namespace {

std::optional<sockaddr_in> addressOf(const std::string& ipv4, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  if (inet_pton(AF_INET, ipv4.c_str(), &address.sin_addr) != 1) return std::nullopt;
  return address;
}

/// Small messages leave at once; a peer whose cable is pulled is noticed.
void prepare(int fd) {
  const int on = 1;
  sendAtOnce(fd);
  setsockopt(fd, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
}

}  // namespace

TcpSocket& TcpSocket::operator=(TcpSocket&& other) noexcept {
  if (this == &other) return *this;
  close();
  fd_ = other.fd_;
  other.fd_ = -1;
  return *this;
}

void TcpSocket::close() {
  if (fd_ >= 0) closeSocket(fd_);
  fd_ = -1;
}

TcpSocket TcpSocket::connecting(const std::string& ipv4, std::uint16_t port) {
  const auto address = addressOf(ipv4, port);
  TcpSocket made(address ? socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0) : -1);
  if (!made.open()) return made;
  prepare(made.fd_);
  if (connect(made.fd_, reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0 &&
      errno != EINPROGRESS)
    made.close();
  return made;
}

TcpSocket::Progress TcpSocket::connected(int wait_ms) const {
  if (!open()) return Progress::failed;
  if (!ready(fd_, Wait::to_write, wait_ms)) return Progress::pending;
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(fd_, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0 ? Progress::done
                                                                                 : Progress::failed;
}

std::size_t TcpSocket::send(std::span<const std::uint8_t> bytes) {
  if (!open()) return 0;
  const std::optional<std::size_t> sent = sendSome(fd_, bytes.data(), bytes.size());
  if (!sent) close();
  return sent.value_or(0);
}

std::size_t TcpSocket::receive(std::span<std::uint8_t> buffer, int wait_ms) {
  if (!open() || (wait_ms > 0 && !ready(fd_, Wait::to_read, wait_ms))) return 0;
  const std::optional<std::size_t> got = receiveSome(fd_, buffer.data(), buffer.size());
  if (!got) close();
  return got.value_or(0);
}

namespace {

/// Clauses.
std::string whyNotServed(int error) {
  switch (error) {
    case EADDRINUSE:
      return "another program uses this port";
    case EADDRNOTAVAIL:
      return "this computer has no such address";
    case EACCES:
      return "ports below 1024 are the administrator's";
    default:
      return fileTrouble(error).why;
  }
}

std::string whyNotKnown(int error) {
  if (error == EAI_NONAME) return "no computer has this name";
  if (error == EAI_NODATA || error == EAI_ADDRFAMILY) return "it has no IPv4 address";
  if (error == EAI_AGAIN) return "the service that knows names does not answer";
  return "the service that knows names refuses it, error " + std::to_string(error);
}

}  // namespace

TcpListener::TcpListener(const std::string& ipv4, std::uint16_t port, const std::string& what,
                         const std::string& advice) {
  const auto address = addressOf(ipv4, port);
  if (!address)
    throw UsageError(
        "is not a network address of this computer", "\"" + ipv4 + "\"",
        "Write it in figures: 127.0.0.1 for this computer only, 0.0.0.0 for every network");
  fd_ = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  reuseAddress(fd_);
  sockaddr_in got{};
  socklen_t size = sizeof got;
  if (fd_ < 0 || bind(fd_, reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0 ||
      listen(fd_, 8) != 0 || getsockname(fd_, reinterpret_cast<sockaddr*>(&got), &size) != 0) {
    const std::string why = whyNotServed(errno);
    if (fd_ >= 0) closeSocket(fd_);
    throw Error("cannot be served (" + why + ")", what + " at " + ipv4 + ":" + std::to_string(port),
                advice);
  }
  port_ = ntohs(got.sin_port);
}

TcpListener::~TcpListener() { closeSocket(fd_); }

TcpSocket TcpListener::accept() {
  TcpSocket peer(acceptOne(fd_));
  if (peer.open()) prepare(peer.descriptor());
  return peer;
}

std::string ipv4Of(const std::string& host, const std::string& where) {
  addrinfo hints{}, *found = nullptr;
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_STREAM;
  if (const int error = getaddrinfo(host.c_str(), nullptr, &hints, &found); error != 0 || !found)
    throw UsageError("\"" + host + "\" is not known (" + whyNotKnown(error) + ")", where,
                     "Write its address in figures, such as 192.168.1.1, or correct the name");
  char text[INET_ADDRSTRLEN] = "";
  inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(found->ai_addr)->sin_addr, text,
            sizeof text);
  freeaddrinfo(found);
  return text;
}

}  // namespace palpa::os

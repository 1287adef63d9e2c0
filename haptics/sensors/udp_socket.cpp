#include "haptics/sensors/udp_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace palpa::haptics {
namespace {

sockaddr_in ipv4(in_addr host, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr = host;
  address.sin_port = htons(port);
  return address;
}

in_addr hostOf(const std::string& where, const std::string& address) {
  in_addr host{};
  if (inet_pton(AF_INET, address.c_str(), &host) != 1)
    throw UsageError("\"" + address + "\" is not a network address", where,
                     "Write it in figures, as 192.168.1.1.");
  return host;
}

/// 0, or the error number.
int attach(int fd, const sockaddr_in& local, const sockaddr_in& peer) {
  const auto* const from = reinterpret_cast<const sockaddr*>(&local);
  const auto* const to = reinterpret_cast<const sockaddr*>(&peer);
  if (local.sin_port != 0 && bind(fd, from, sizeof local) != 0) return errno;
  return connect(fd, to, sizeof peer) == 0 ? 0 : errno;
}

}  // namespace

Error networkError(int error_number, const std::string& where) {
  switch (error_number) {
    case ENETUNREACH:
    case EHOSTUNREACH:
      return {
          "no route to the sensor", where,
          "Check that the network cable is in, that the network card is on, and that this computer "
          "has an address in the sensor's network."};
    case EADDRINUSE:
      return {"the local port is taken by another program", where,
              "End the other program (a second session?), or set the local port to 0."};
    case ECONNREFUSED:
      return {"the computer at this address does not listen on this port", where,
              "Check that it is the sensor's address, and that RDT is enabled on its web page."};
    case EAGAIN:
      return {
          "nothing answers", where,
          "Check that the sensor has power and a link light, that its address is right, that no "
          "firewall holds back UDP, that no other program reads it (it serves one at a time), and "
          "that the start code fits the model."};
    case EPROTO:
      return {"what answers does not speak RDT", where,
              "Check the address and the port (49152), and that the start code fits the model."};
    case EACCES:
    case EPERM:
      return {
          "this computer does not allow the connection", where,
          "Check the address, the firewall's rules, and that the local port is 0 or above 1023."};
    default:
      return {"the network fails, error " + std::to_string(error_number), where,
              "Check the network card and the cable."};
  }
}

UdpSocket::UdpSocket(const std::string& where, const std::string& address, std::uint16_t port,
                     std::uint16_t local_port) {
  const sockaddr_in peer = ipv4(hostOf(where, address), port);
  fd_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd_ < 0) throw networkError(errno, where);
  if (const int error = attach(fd_, ipv4({INADDR_ANY}, local_port), peer)) {
    close(fd_);
    throw networkError(error, where);
  }
}

UdpSocket::~UdpSocket() { close(fd_); }

int UdpSocket::send(std::span<const std::uint8_t> bytes) noexcept {
  const auto sent = [&] {
    return ::send(fd_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL) >= 0;
  };
  // A refusal reported here answers an earlier datagram; this one has not left yet.
  return sent() || (errno == ECONNREFUSED && sent()) ? 0 : errno;
}

UdpSocket::Received UdpSocket::receive(std::span<std::uint8_t> buffer, int timeout_ms) noexcept {
  pollfd waiting{fd_, POLLIN, 0};
  const int ready = poll(&waiting, 1, timeout_ms);
  if (ready <= 0) return {0, ready == 0 || errno == EINTR ? EAGAIN : errno};
  const ssize_t n = recv(fd_, buffer.data(), buffer.size(), MSG_DONTWAIT | MSG_TRUNC);
  if (n < 0) return {0, errno};
  return {static_cast<std::size_t>(n), 0};
}

}  // namespace palpa::haptics

#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "anatomy/base/error.h"

namespace palpa::haptics {

/// A UDP socket (IPv4) that talks to one peer. Set-up throws Error; send and receive return.
class UdpSocket {
 public:
  /// `address` in figures (192.168.1.1); `local_port` 0: any. `where` begins every message.
  UdpSocket(const std::string& where, const std::string& address, std::uint16_t port,
            std::uint16_t local_port);
  ~UdpSocket();
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  /// 0, or the system's error number.
  int send(std::span<const std::uint8_t> bytes) noexcept;

  struct Received {
    std::size_t bytes = 0;  ///< true length of the datagram, also when it is longer than the buffer
    int error = 0;          ///< system's error number; EAGAIN: nothing came in time
  };
  /// Waits for one datagram, at most `timeout_ms`.
  Received receive(std::span<std::uint8_t> buffer, int timeout_ms) noexcept;

 private:
  int fd_;
};

/// What a failed set-up or request means, in plain words: what, and what to check.
Error networkError(int error_number, const std::string& where);

}  // namespace palpa::haptics

#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace palpa::os {

/// A TCP connection whose calls never wait, unless told how long. Closed when it goes.
class TcpSocket {
 public:
  TcpSocket() = default;
  explicit TcpSocket(int fd) : fd_(fd) {}
  ~TcpSocket() { close(); }
  TcpSocket(TcpSocket&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  TcpSocket& operator=(TcpSocket&& other) noexcept;

  /// Begins to connect to an address in figures. Check with `connected`.
  static TcpSocket connecting(const std::string& ipv4, std::uint16_t port);
  enum class Progress { pending, done, failed };
  /// How the connecting went, after at most `wait_ms`.
  Progress connected(int wait_ms) const;

  int descriptor() const { return fd_; }
  bool open() const { return fd_ >= 0; }
  void close();
  /// Bytes taken; 0: it would have to wait. Closes itself where the peer is gone.
  std::size_t send(std::span<const std::uint8_t> bytes);
  /// Bytes that are there, after at most `wait_ms`; 0: none. Closes itself where the peer is gone.
  std::size_t receive(std::span<std::uint8_t> buffer, int wait_ms = 0);

 private:
  int fd_ = -1;
};

/// Waits for whoever connects.
class TcpListener {
 public:
  /// IPv4 in figures; port 0: any that is free. Throws UsageError (address), or Error (port taken)
  /// with the name of `what` is served there and `advice`.
  TcpListener(const std::string& ipv4, std::uint16_t port, const std::string& what = "a server",
              const std::string& advice = "Choose another port");
  ~TcpListener();
  TcpListener(const TcpListener&) = delete;
  TcpListener& operator=(const TcpListener&) = delete;
  std::uint16_t port() const { return port_; }
  /// One of those who wait; not open: nobody does.
  TcpSocket accept();

 private:
  int fd_ = -1;
  std::uint16_t port_ = 0;
};

/// The address of a name, in figures: asked once, since asking for a name may wait. Throws
/// UsageError.
std::string ipv4Of(const std::string& host, const std::string& where);

}  // namespace palpa::os

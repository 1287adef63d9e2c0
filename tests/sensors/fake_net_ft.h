#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace palpa::haptics {

using Bytes = std::vector<std::uint8_t>;

inline void putBigEndian(Bytes& to, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) to.push_back(static_cast<std::uint8_t>(value >> shift));
}

/// A record as the sensor sends it, written apart from the code under test.
inline Bytes recordBytes(std::uint32_t rdt, std::uint32_t ft, std::uint32_t status = 0,
                         std::array<std::int32_t, 6> counts = {}) {
  Bytes bytes;
  for (const std::uint32_t word : {rdt, ft, status}) putBigEndian(bytes, word);
  for (const std::int32_t count : counts) putBigEndian(bytes, static_cast<std::uint32_t>(count));
  return bytes;
}

inline Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A UDP server on the loopback that behaves like the sensor's network box: its thread keeps every
/// request and answers a start with `answer` (empty: not at all); the test sends what it likes.
class FakeNetFt {
 public:
  explicit FakeNetFt(Bytes answer = recordBytes(1, 100), std::uint16_t port = 0)
      : answer_(std::move(answer)), fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(bind(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    socklen_t size = sizeof address;
    getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~FakeNetFt() {
    stop_ = true;
    thread_.join();
    close(fd_);
  }
  std::uint16_t port() const { return port_; }

  void send(const Bytes& datagram) {
    const std::lock_guard lock(mutex_);
    sendto(fd_, datagram.data(), datagram.size(), 0, reinterpret_cast<sockaddr*>(&peer_),
           sizeof peer_);
  }
  /// Waits until `n` such requests have come; false after ten seconds without.
  bool heard(const Bytes& request, std::ptrdiff_t n = 1) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(10), [&] {
      return std::count(requests_.begin(), requests_.end(), request) >= n;
    });
  }
  std::vector<Bytes> requests() {
    const std::lock_guard lock(mutex_);
    return requests_;
  }

 private:
  void serve() {
    while (!stop_) {
      pollfd waiting{fd_, POLLIN, 0};
      if (poll(&waiting, 1, 5) <= 0) continue;
      Bytes request(64);
      sockaddr_in from{};
      socklen_t size = sizeof from;
      const ssize_t n = recvfrom(fd_, request.data(), request.size(), 0,
                                 reinterpret_cast<sockaddr*>(&from), &size);
      if (n < 0) continue;
      request.resize(static_cast<std::size_t>(n));
      keep(request, from);
      if (request.size() == 8 && request[3] == 2 && !answer_.empty()) send(answer_);
    }
  }
  void keep(const Bytes& request, const sockaddr_in& from) {
    const std::lock_guard lock(mutex_);
    requests_.push_back(request);
    peer_ = from;
    changed_.notify_all();
  }

  Bytes answer_;
  int fd_;
  std::uint16_t port_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Bytes> requests_;
  sockaddr_in peer_{};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

inline const Bytes kStartBytes{0x12, 0x34, 0, 2, 0, 0, 0, 0};
inline const Bytes kStopBytes{0x12, 0x34, 0, 0, 0, 0, 0, 0};
inline const Bytes kBiasBytes{0x12, 0x34, 0, 0x42, 0, 0, 0, 0};

}  // namespace palpa::haptics

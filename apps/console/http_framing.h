#pragma once

#include <chrono>
#include <string>

#include "apps/console/guard.h"
#include "apps/console/http.h"
#include "apps/runtime/clock.h"

namespace palpa::console {

/// A connection whose request must be complete by a moment and within a size, however slowly its
/// bytes come; answers may take as long as they are taken off.
class DeadlineStream final : public httplib::Stream {
 public:
  using Clock = runtime::ServingClock;
  explicit DeadlineStream(int socket);

  /// From here a request may be read, until `deadline` and up to `most` bytes.
  void begin(Clock::time_point deadline, std::size_t most);
  /// The next request begins within this time.
  bool waits(std::chrono::milliseconds time) const;

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }
  const std::string& remote() const { return remote_; }
  bool cut() const { return cut_; }    ///< it was too slow or too long
  bool left() const { return left_; }  ///< the other side ended it

 private:
  bool fill();
  const int socket_;
  std::string remote_;
  Clock::time_point deadline_;
  std::size_t most_ = 0;  ///< bytes that may still come
  std::string buffer_;
  std::size_t at_ = 0;
  bool cut_ = false, left_ = false;
};

inline constexpr std::size_t kLongestBody = 64u << 10;

/// Whether a request is framed as the pages frame theirs: a POST with a body of stated, small
/// length, a GET without one, nothing packed, nothing in parts. All else is refused before a body
/// is read: a length that can be read in two ways lets one request hide in another, a packed body
/// grows without bound when it is unpacked, a list of parts makes a small question into a large
/// answer.
GuardVerdict judgeFraming(const httplib::Request& request);

}  // namespace palpa::console

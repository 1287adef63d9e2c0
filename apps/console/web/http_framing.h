#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "apps/console/web/guard.h"
#include "apps/console/web/httplib_server.h"
#include "apps/os/socket.h"
#include "apps/runtime/clock.h"

namespace palpa::console {

/// A connection whose request must be complete by a moment and within a size, however slowly its
/// bytes come, and whose answer must be taken off by another moment.
class DeadlineStream final : public httplib::Stream {
 public:
  using Clock = runtime::ServingClock;
  /// `begun`: what has been read of its request already.
  explicit DeadlineStream(os::Line& line, std::string begun = "");

  /// From here a request may be read, until `deadline` and up to `most` bytes that have not come.
  void begin(Clock::time_point deadline, std::size_t most);
  /// How long its answer may take, and of this how long nothing of it need be taken off.
  void answerWithin(std::chrono::milliseconds whole, std::chrono::milliseconds stalled);
  /// The next request begins within this time.
  bool waits(std::chrono::milliseconds time) const;

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return line_.socket(); }
  const std::string& remote() const { return remote_; }
  bool cut() const { return cut_; }                         ///< it was too slow or too long
  bool left() const { return left_; }                       ///< the other side ended it
  std::string rest() const { return buffer_.substr(at_); }  ///< of the next request

 private:
  bool fill();
  os::Line& line_;
  std::string remote_;
  Clock::time_point deadline_, answered_ = Clock::time_point::max();
  std::chrono::milliseconds stalled_{10'000};
  std::size_t most_ = 0;  ///< bytes that may still come
  std::string buffer_;
  std::size_t at_ = 0;
  bool cut_ = false, left_ = false;
};

inline constexpr std::size_t kLongestBody = 64u << 10;

/// Where a request's head ends: behind its empty line; npos: not yet.
std::size_t endOfHead(std::string_view bytes);
/// The length of the body that a head states; 0 where it states none, nothing where it is no number
/// or stands there twice.
std::optional<std::size_t> bodyLengthIn(std::string_view head);
/// What the guard judges of a head as it came, before anything is made of it; and of a request that
/// was read. Where a header stands twice, its first.
GuardedRequest askedIn(std::string_view head, const std::string& remote);
GuardedRequest askedOf(const httplib::Request& request);
/// A head as it came, before anything is made of it: a line that is folded, a blank before the
/// colon, a line end of one character and a control character are read differently by different
/// programs, so that one request could hide in another. All are refused.
GuardVerdict judgeHead(std::string_view head);

/// Whether a request is framed as the pages frame theirs: a POST with a body of stated, small
/// length, a GET without one, nothing packed, nothing in parts. All else is refused before a body
/// is read: a length that can be read in two ways lets one request hide in another, a packed body
/// grows without bound when it is unpacked, a list of parts makes a small question into a large
/// answer.
GuardVerdict judgeFraming(const httplib::Request& request);

}  // namespace palpa::console

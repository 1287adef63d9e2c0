#include "apps/console/http_framing.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>

#include "apps/os/socket.h"

namespace palpa::console {
namespace {

constexpr int kWrite_ms = 10'000;

bool readable(int socket, std::chrono::milliseconds time) {
  return os::ready(socket, os::Wait::to_read,
                   static_cast<int>(std::max<std::int64_t>(0, time.count())));
}

void assign(const std::optional<os::Address>& address, std::string* ip, int* port) {
  if (!address) return;
  *ip = address->ip;
  *port = address->port;
}

}  // namespace

DeadlineStream::DeadlineStream(int socket) : socket_(socket) {
  int port = 0;
  get_remote_ip_and_port(remote_, port);
}

void DeadlineStream::begin(Clock::time_point deadline, std::size_t most) {
  deadline_ = deadline;
  most_ = most;
}

bool DeadlineStream::waits(std::chrono::milliseconds time) const {
  return at_ < buffer_.size() || readable(socket_, time);
}

bool DeadlineStream::is_readable() const {
  return at_ < buffer_.size() ||
         readable(socket_,
                  std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now()));
}

/// False as soon as the other side is gone: a stream of pictures ends with its reader.
bool DeadlineStream::is_writable() const { return os::readerTakes(socket_, kWrite_ms); }

bool DeadlineStream::fill() {
  if (most_ == 0 || !is_readable()) {
    cut_ = true;
    return false;
  }
  char bytes[4096];
  const std::size_t count =
      os::receiveSome(socket_, bytes, std::min(sizeof bytes, most_)).value_or(0);
  left_ = count == 0;
  if (left_) return false;
  most_ -= count;
  buffer_.assign(bytes, count);
  at_ = 0;
  return true;
}

ssize_t DeadlineStream::read(char* to, std::size_t size) {
  if (at_ >= buffer_.size() && !fill()) return -1;
  const std::size_t count = std::min(size, buffer_.size() - at_);
  std::memcpy(to, buffer_.data() + at_, count);
  at_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t DeadlineStream::write(const char* from, std::size_t size) {
  if (!is_writable()) return -1;
  const std::optional<std::size_t> count = os::sendWaiting(socket_, from, size);
  return count ? static_cast<ssize_t>(*count) : -1;
}

void DeadlineStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  assign(os::peerOf(socket_), &ip, &port);
}

void DeadlineStream::get_local_ip_and_port(std::string& ip, int& port) const {
  assign(os::ownOf(socket_), &ip, &port);
}

namespace {

/// kLongestBody + 1: too much, whatever was said; nullopt: no whole number.
std::optional<std::size_t> lengthIn(const std::string& text) {
  constexpr std::size_t kDigits = 19;
  if (text.empty() ||
      !std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }))
    return std::nullopt;
  return text.size() > kDigits ? kLongestBody + 1
                               : std::min<std::size_t>(std::stoull(text), kLongestBody + 1);
}

}  // namespace

GuardVerdict judgeFraming(const httplib::Request& r) {
  for (const char* once :
       {"Host", "Origin", "Content-Length", "Content-Type", "X-Palpa-Page", "X-Palpa-Write"})
    if (r.get_header_value_count(once) > 1) return {400, std::string("has ") + once + " twice"};
  if (r.has_header("Transfer-Encoding")) return {411, "a body must state its length"};
  if (r.has_header("Content-Encoding")) return {415, "a body must not be compressed"};
  if (r.has_header("Range")) return {416, "parts of an answer cannot be requested"};
  const bool stated = r.has_header("Content-Length");
  const std::optional<std::size_t> length =
      stated ? lengthIn(r.get_header_value("Content-Length")) : std::size_t{0};
  if (!length) return {400, "the body's length is not a number"};
  if (r.method == "POST" && !stated) return {411, "a body must state its length"};
  if (r.method != "POST" && *length > 0) return {400, "only a POST has a body"};
  if (*length > kLongestBody) return {413, "is longer than 64 KiB"};
  return {};
}

}  // namespace palpa::console

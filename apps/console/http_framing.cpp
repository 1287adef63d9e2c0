#include "apps/console/http_framing.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>

#include <arpa/inet.h>
#include <netinet/in.h>

namespace palpa::console {
namespace {

constexpr int kWrite_ms = 10'000;

bool ready(int socket, short what, std::chrono::milliseconds time) {
  pollfd one{socket, what, 0};
  return ::poll(&one, 1, static_cast<int>(std::max<std::int64_t>(0, time.count()))) == 1;
}

void addressOf(const sockaddr_storage& from, std::string* ip, int* port) {
  char text[INET6_ADDRSTRLEN] = "";
  if (from.ss_family == AF_INET) {
    const auto& v4 = reinterpret_cast<const sockaddr_in&>(from);
    ::inet_ntop(AF_INET, &v4.sin_addr, text, sizeof text);
    *port = ntohs(v4.sin_port);
  } else if (from.ss_family == AF_INET6) {
    const auto& v6 = reinterpret_cast<const sockaddr_in6&>(from);
    ::inet_ntop(AF_INET6, &v6.sin6_addr, text, sizeof text);
    *port = ntohs(v6.sin6_port);
  }
  *ip = text;
}

}  // namespace

DeadlineStream::DeadlineStream(int socket) : socket_(socket) {
  int port = 0;
  get_remote_ip_and_port(remote_, port);
}

void DeadlineStream::begin(Clock::time_point deadline, std::size_t most) {
  deadline_ = deadline;
  left_ = most;
}

bool DeadlineStream::waits(std::chrono::milliseconds time) const {
  return at_ < buffer_.size() || ready(socket_, POLLIN, time);
}

bool DeadlineStream::is_readable() const {
  return at_ < buffer_.size() ||
         ready(socket_, POLLIN,
               std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now()));
}

/// False as soon as the other side is gone: a stream of pictures ends with its reader.
bool DeadlineStream::is_writable() const {
  pollfd one{socket_, POLLOUT | POLLRDHUP, 0};
  return ::poll(&one, 1, kWrite_ms) == 1 && !(one.revents & (POLLERR | POLLHUP | POLLRDHUP)) &&
         (one.revents & POLLOUT);
}

bool DeadlineStream::fill() {
  if (left_ == 0 || !is_readable()) {
    cut_ = true;
    return false;
  }
  char bytes[4096];
  const ssize_t count = ::recv(socket_, bytes, std::min(sizeof bytes, left_), 0);
  if (count <= 0) return false;
  left_ -= static_cast<std::size_t>(count);
  buffer_.assign(bytes, static_cast<std::size_t>(count));
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
  return ::send(socket_, from, size, MSG_NOSIGNAL);
}

void DeadlineStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage from{};
  socklen_t size = sizeof from;
  if (::getpeername(socket_, reinterpret_cast<sockaddr*>(&from), &size) == 0)
    addressOf(from, &ip, &port);
}

void DeadlineStream::get_local_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage from{};
  socklen_t size = sizeof from;
  if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&from), &size) == 0)
    addressOf(from, &ip, &port);
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

Verdict judgeFraming(const httplib::Request& r) {
  for (const char* once :
       {"Host", "Origin", "Content-Length", "Content-Type", "X-Palpa-Page", "X-Palpa-Write"})
    if (r.get_header_value_count(once) > 1) return {400, std::string("says ") + once + " twice"};
  if (r.has_header("Transfer-Encoding")) return {411, "a body is sent with its length"};
  if (r.has_header("Content-Encoding")) return {415, "a body is not packed"};
  if (r.has_header("Range")) return {416, "parts of an answer are not to be had"};
  const bool stated = r.has_header("Content-Length");
  const std::optional<std::size_t> length =
      stated ? lengthIn(r.get_header_value("Content-Length")) : std::size_t{0};
  if (!length) return {400, "the body's length is no number"};
  if (r.method == "POST" && !stated) return {411, "a body is sent with its length"};
  if (r.method != "POST" && *length > 0) return {400, "only a POST has a body"};
  if (*length > kLongestBody) return {413, "is longer than 64 KiB"};
  return {};
}

}  // namespace palpa::console

#include "apps/console/web/http_framing.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/os/socket.h"

namespace palpa::console {
namespace {

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

DeadlineStream::DeadlineStream(os::Line& line, std::string begun)
    : line_(line), buffer_(std::move(begun)) {
  int port = 0;
  get_remote_ip_and_port(remote_, port);
}

void DeadlineStream::begin(Clock::time_point deadline, std::size_t most) {
  deadline_ = deadline;
  most_ = most;
}

void DeadlineStream::answerWithin(std::chrono::milliseconds whole,
                                  std::chrono::milliseconds stalled) {
  answered_ =
      whole == std::chrono::milliseconds::max() ? Clock::time_point::max() : Clock::now() + whole;
  stalled_ = stalled;
}

bool DeadlineStream::waits(std::chrono::milliseconds time) const {
  return at_ < buffer_.size() || line_.holdsMore() || readable(socket(), time);
}

bool DeadlineStream::is_readable() const {
  return at_ < buffer_.size() || line_.holdsMore() ||
         readable(socket(),
                  std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now()));
}

/// False as soon as the other side is gone: a stream of pictures ends with its reader.
bool DeadlineStream::is_writable() const {
  return Clock::now() < answered_ && os::readerTakes(socket(), static_cast<int>(stalled_.count()));
}

/// Of an encrypted line a part may have come that gives nothing yet.
bool DeadlineStream::fill() {
  char bytes[4096];
  for (std::size_t count = 0; count == 0;) {
    if (most_ == 0 || !is_readable()) {
      cut_ = true;
      return false;
    }
    const std::optional<std::size_t> got = line_.receiveSome(bytes, std::min(sizeof bytes, most_));
    left_ = !got;
    if (left_) return false;
    count = *got;
    most_ -= count;
    buffer_.assign(bytes, count);
    at_ = 0;
  }
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
  const std::optional<std::size_t> count = line_.sendSome(from, size);
  return count ? static_cast<ssize_t>(*count) : -1;
}

void DeadlineStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  assign(os::peerOf(socket()), &ip, &port);
}

void DeadlineStream::get_local_ip_and_port(std::string& ip, int& port) const {
  assign(os::ownOf(socket()), &ip, &port);
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

constexpr std::string_view kLineEnd = "\r\n";

/// The lines of a head without their ends, without the empty one.
std::vector<std::string_view> linesOf(std::string_view head) {
  std::vector<std::string_view> lines;
  for (std::size_t at = 0, end; at < head.size(); at = end + kLineEnd.size()) {
    end = std::min(head.find(kLineEnd, at), head.size());
    if (end > at) lines.push_back(head.substr(at, end - at));
  }
  return lines;
}

bool isBlank(char c) { return c == ' ' || c == '\t'; }

bool standsInAName(unsigned char c) {
  constexpr std::string_view kMarks = "!#$%&'*+-.^_`|~";
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         kMarks.find(static_cast<char>(c)) != std::string_view::npos;
}

bool isControl(unsigned char c) { return (c < 0x20 && c != '\t') || c == 0x7f; }

bool isNamed(std::string_view name, std::string_view wanted) {
  return std::equal(name.begin(), name.end(), wanted.begin(), wanted.end(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

/// Of a header, wherever a head has it, without the blanks before them.
std::vector<std::string_view> valuesIn(std::string_view head, std::string_view name) {
  std::vector<std::string_view> values;
  for (const std::string_view line : linesOf(head)) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !isNamed(line.substr(0, colon), name)) continue;
    std::string_view value = line.substr(colon + 1);
    while (!value.empty() && isBlank(value.front())) value.remove_prefix(1);
    values.push_back(value);
  }
  return values;
}

template <class ValueOf>
GuardedRequest asked(const std::string& remote, const std::string& method, const std::string& path,
                     ValueOf valueOf) {
  return {.remote = remote,
          .method = method,
          .path = path,
          .host = valueOf("host"),
          .origin = valueOf("origin"),
          .fetch_site = valueOf("sec-fetch-site"),
          .content_type = valueOf("content-type"),
          .cookie = valueOf("cookie"),
          .page_key = valueOf("x-palpa-page"),
          .write_id = valueOf("x-palpa-write")};
}

const char* whyNoHeader(std::string_view line) {
  if (isBlank(line.front())) return "a header is folded over two lines";
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || colon == 0) return "a header has no name";
  if (isBlank(line[colon - 1])) return "a header has a blank before its colon";
  return std::all_of(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(colon), standsInAName)
             ? nullptr
             : "a header's name is none";
}

}  // namespace

std::size_t endOfHead(std::string_view bytes) {
  const std::size_t end = bytes.find("\r\n\r\n");
  return end == std::string_view::npos ? end : end + 2 * kLineEnd.size();
}

std::optional<std::size_t> bodyLengthIn(std::string_view head) {
  const std::vector<std::string_view> stated = valuesIn(head, "content-length");
  if (stated.empty()) return 0;
  return stated.size() == 1 ? lengthIn(std::string(stated.front())) : std::nullopt;
}

GuardedRequest askedIn(std::string_view head, const std::string& remote) {
  const std::string_view line = head.substr(0, head.find(kLineEnd));
  const std::size_t method = std::min(line.find(' '), line.size()),
                    target = std::min(method + 1, line.size());
  return asked(remote, std::string(line.substr(0, method)),
               std::string(line.substr(target, line.find(' ', target) - target)),
               [head](std::string_view name) {
                 const std::vector<std::string_view> all = valuesIn(head, name);
                 return all.empty() ? std::string() : std::string(all.front());
               });
}

GuardedRequest askedOf(const httplib::Request& r) {
  return asked(r.remote_addr, r.method, r.path,
               [&r](const char* name) { return r.get_header_value(name); });
}

GuardVerdict judgeHead(std::string_view head) {
  const std::vector<std::string_view> lines = linesOf(head);
  for (const std::string_view line : lines)
    if (std::any_of(line.begin(), line.end(), isControl))
      return {400, "has a control character in its head"};
  for (std::size_t i = 1; i < lines.size(); ++i)
    if (const char* why = whyNoHeader(lines[i])) return {400, why};
  return {};
}

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

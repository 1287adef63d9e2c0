#include "raw_http.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

#include "apps/runtime/clock.h"

namespace palpa::console_attack {
namespace {

using Clock = runtime::ServingClock;

sockaddr_in addressOf(const std::string& ip, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  ::inet_pton(AF_INET, ip.c_str(), &address.sin_addr);
  return address;
}

int untilOver(Clock::time_point until) {
  return static_cast<int>(std::max<std::int64_t>(
      0, std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count()));
}

}  // namespace

Wire::Wire(int port, const std::string& from)
    : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const sockaddr_in there = addressOf("127.0.0.1", port), here = addressOf(from, 0);
  const bool bound =
      from.empty() || ::bind(socket_, reinterpret_cast<const sockaddr*>(&here), sizeof here) == 0;
  if (!bound || ::connect(socket_, reinterpret_cast<const sockaddr*>(&there), sizeof there) != 0)
    leave();
}

Wire::~Wire() { leave(); }

void Wire::leave() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

std::size_t Wire::send(const std::string& bytes, std::chrono::milliseconds patience) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    pollfd one{socket_, POLLOUT, 0};
    if (::poll(&one, 1, static_cast<int>(patience.count())) != 1) break;
    const ssize_t count =
        ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0) break;
    sent += static_cast<std::size_t>(count);
  }
  return sent;
}

std::string Wire::readSome(std::chrono::milliseconds patience) {
  pollfd one{socket_, POLLIN, 0};
  if (::poll(&one, 1, static_cast<int>(patience.count())) != 1) return "";
  char bytes[65536];
  const ssize_t count = ::recv(socket_, bytes, sizeof bytes, 0);
  closed_ = count <= 0;
  return closed_ ? "" : std::string(bytes, static_cast<std::size_t>(count));
}

std::string Wire::read(std::chrono::milliseconds patience, std::size_t most) {
  const auto until = Clock::now() + patience;
  std::string all;
  while (all.size() < most && !closed_ && Clock::now() < until)
    all += readSome(std::chrono::milliseconds(untilOver(until)));
  return all;
}

std::string Answer::header(const std::string& name) const {
  const std::size_t at = head.find("\r\n" + name + ": ");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + name.size() + 4;
  return head.substr(begin, head.find("\r\n", begin) - begin);
}

Answer answerIn(const std::string& bytes) {
  Answer answer;
  const std::size_t end = bytes.find("\r\n\r\n");
  if (bytes.rfind("HTTP/1.1 ", 0) != 0 || end == std::string::npos) return answer;
  answer.status = std::atoi(bytes.c_str() + 9);
  answer.head = bytes.substr(0, end + 2);
  answer.body = bytes.substr(end + 4);
  return answer;
}

std::string requestOf(const std::string& method, const std::string& path, const Headers& headers,
                      const std::string& body) {
  std::string request = method + " " + path + " HTTP/1.1\r\n";
  for (const auto& [name, value] : headers) request += name + ": " + value + "\r\n";
  return request + "\r\n" + body;
}

std::vector<Event> eventsIn(std::string& bytes) {
  std::vector<Event> all;
  for (std::size_t begin; (begin = bytes.find("id: ")) != std::string::npos;) {
    const std::size_t data = bytes.find("\ndata: ", begin), end = bytes.find("\n\n", begin);
    if (data == std::string::npos || end == std::string::npos) break;
    all.push_back({std::stoul(bytes.substr(begin + 4)),
                   nlohmann::json::parse(bytes.substr(data + 7, end - data - 7), nullptr, false)});
    bytes.erase(0, end + 2);
  }
  return all;
}

}  // namespace palpa::console_attack

#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace palpa::console_attack {

/// A connection that sends whatever bytes it is told to.
class Wire {
 public:
  /// From another address of this computer where `from` says so (127.0.0.2).
  explicit Wire(int port, const std::string& from = "");
  ~Wire();
  Wire(Wire&& other) noexcept : socket_(other.socket_) { other.socket_ = -1; }
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;
  Wire& operator=(Wire&& other) noexcept {
    leave();
    socket_ = other.socket_;
    closed_ = other.closed_;
    other.socket_ = -1;
    return *this;
  }

  bool connected() const { return socket_ >= 0; }
  /// How many bytes were taken; fewer than all: the other side has gone, or took nothing for
  /// `patience`.
  std::size_t send(const std::string& bytes,
                   std::chrono::milliseconds patience = std::chrono::seconds(20));
  /// What comes until the other side closes, or there are `most` bytes, or `patience` is over.
  std::string read(std::chrono::milliseconds patience, std::size_t most = 64u << 20);
  /// What comes next; empty: closed, or nothing came within `patience`.
  std::string readSome(std::chrono::milliseconds patience);
  bool closed() const { return closed_; }  ///< by the other side, as far as was read
  void leave();

 private:
  int socket_ = -1;
  bool closed_ = false;
};

struct Answer {
  int status = 0;  ///< 0: none came
  std::string head, body;
  std::string header(const std::string& name) const;  ///< empty: none
  nlohmann::json json() const { return nlohmann::json::parse(body, nullptr, false); }
};
Answer answerIn(const std::string& bytes);

using Headers = std::vector<std::pair<std::string, std::string>>;
std::string requestOf(const std::string& method, const std::string& path, const Headers& headers,
                      const std::string& body = "");

struct Event {
  std::size_t id = 0;
  nlohmann::json data;
  bool operator==(const Event&) const = default;
};
/// Whole events of a stream; what is not whole yet stays in `bytes`.
std::vector<Event> eventsIn(std::string& bytes);

}  // namespace palpa::console_attack

#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include <httplib.h>
#undef _res  // a macro of <resolv.h>, a name in Eigen

namespace palpa::link {

/// How much of an answer may come: of its first line, of its head with that, of its body. The
/// library reads a line of any length, and takes long ones apart by means that need as much stack.
struct AnswerBounds {
  std::size_t first_line = 1u << 10, head = 64u << 10, body = 1u << 20;
};

/// What an answer has taken of its bounds.
struct AnswerCount {
  bool in_body = false;  ///< its head has ended
  bool too_long = false;
  std::size_t bytes = 0;  ///< of the part at hand
  bool line_ended = false;
};

/// The library's client for `host`, each of whose answers ends where it goes beyond `bounds`:
/// `count` says so then. Both outlive it; `count` is reset for each request, and told when the head
/// has ended.
std::unique_ptr<httplib::ClientImpl> boundedClient(const std::string& host, int port, bool tls,
                                                   const AnswerBounds& bounds, AnswerCount& count);

}  // namespace palpa::link

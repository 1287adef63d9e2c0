#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "anatomy/base/error.h"
#include "apps/trial/trial_status.h"

/// Between a running session and whoever looks on: frames over a local socket, kind (1 byte),
/// length (4 bytes, little-endian), body.
namespace palpa::live {

enum class FrameKind : char {
  entry = 'L',    ///< session -> console: the next entry of its log, a JSON object
  picture = 'P',  ///< session -> console: what is on the screen, JPEG
  /// Session -> console, once, first: how many entries its log held when the console came; with as
  /// many it has caught up
  known = 'K',
  command = 'C',  ///< console -> session: {"command", "reason", "at_s", "trial"}
  watch = 'W',    ///< console -> session: "1": pictures are wanted; "0": nobody looks
  /// The emergency stop, at its own socket; the session sends it back when it has it. Empty
  stop = 'S'
};

struct LiveFrame {
  FrameKind kind = FrameKind::entry;
  std::string body;
};

inline constexpr std::size_t kLongestPicture = 8u << 20, kLongestEntry = 1u << 20,
                             kLongestCommand = 8u << 10, kLongestCount = 20;

/// The socket of the emergency stop beside that of a session.
std::string stopSocketOf(const std::string& session_socket);

std::string encoded(FrameKind kind, const std::string& body);

/// Frames out of bytes as they come, in whatever pieces. Throws Error for what is no frame, or one
/// longer than its kind may be: the peer is then to be left.
class FrameDecoder {
 public:
  void feed(const char* bytes, std::size_t count) { pending_.append(bytes, count); }
  std::optional<LiveFrame> next();

 private:
  std::string pending_;
};

/// {"command": "start|pause|abort|void|stop|rearm|leave|note", "reason": "...", "at_s": 12.4,
/// "trial": 2} as a request to the task. Throws UsageError for what is none: unknown command, void
/// without a reason, an empty note, a text over 500 characters or with control characters, an
/// `at_s` that is no second of a session, a `trial` that is no number of one. `at_s`: the moment of
/// a note, session time. `trial`: the only one that is to be void, or aborted.
trial::UserRequest parseSteering(const std::string& json);

}  // namespace palpa::live

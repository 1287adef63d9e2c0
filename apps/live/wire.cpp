#include "apps/live/wire.h"

#include <cstdint>

namespace palpa::live {
namespace {

constexpr std::size_t kHead = 5;

std::size_t longest(char kind) {
  switch (static_cast<FrameKind>(kind)) {
    case FrameKind::entry:
      return kLongestEntry;
    case FrameKind::picture:
      return kLongestPicture;
    case FrameKind::command:
      return kLongestCommand;
    case FrameKind::known:
      return kLongestCount;
    case FrameKind::watch:
      return 1;
  }
  throw Error("is no kind of frame", "local socket of a session",
              "Console and session are of different versions: start both anew");
}

}  // namespace

std::string encoded(FrameKind kind, const std::string& body) {
  std::string frame(1, static_cast<char>(kind));
  for (int shift = 0; shift < 32; shift += 8)
    frame.push_back(static_cast<char>(body.size() >> shift & 0xff));
  return frame + body;
}

std::optional<Frame> FrameDecoder::next() {
  if (pending_.size() < kHead) return std::nullopt;
  std::size_t length = 0;
  for (std::size_t i = 0; i < 4; ++i)
    length |= static_cast<std::size_t>(static_cast<std::uint8_t>(pending_[1 + i])) << (8 * i);
  if (length > longest(pending_[0]))
    throw Error("is longer than it may be", "a frame on the local socket of a session",
                "Console and session are of different versions: start both anew");
  if (pending_.size() < kHead + length) return std::nullopt;
  Frame frame{static_cast<FrameKind>(pending_[0]), pending_.substr(kHead, length)};
  pending_.erase(0, kHead + length);
  return frame;
}

}  // namespace palpa::live

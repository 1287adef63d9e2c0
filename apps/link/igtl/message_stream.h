#pragma once

#include <cstdint>
#include <optional>

#include "apps/link/igtl/wire.h"

namespace palpa::igt {

/// What came, and what was passed over.
struct StreamCounts {
  std::uint64_t messages = 0;  ///< whole, with the right checksum, of a type that is read here
  std::uint64_t skipped =
      0;  ///< of other types, of later versions, or too large to be kept: passed over by their size
  std::uint64_t damaged = 0;  ///< dropped: wrong checksum, or sizes that do not add up
};

struct Message {
  Header header;
  Bytes content;
  std::map<std::string, std::string> metadata;
};

/// Messages out of a stream of bytes, however these come in pieces. Holds at most one message of
/// `kLargestBody`; what is larger, as a picture, is passed over by its size without being kept. A
/// header that cannot be one ends it: from there nobody knows where the next message begins.
class MessageStream {
 public:
  static constexpr std::size_t kLargestBody = 64 * 1024;
  static constexpr std::uint64_t kLargestSkip = 1ull << 30;  ///< a larger body is no OpenIGTLink

  /// Takes bytes; `next` must have returned nothing before, so that no more than one call's bytes
  /// wait.
  void feed(View bytes) { waiting_.insert(waiting_.end(), bytes.begin(), bytes.end()); }
  /// The next whole message; nothing: more bytes are needed, or `broken`.
  std::optional<Message> next();
  bool broken() const { return broken_; }
  const StreamCounts& counts() const { return counts_; }

 private:
  bool takeHeader();
  std::optional<Message> takeBody();
  void drop(std::size_t bytes) {
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(bytes));
  }

  Bytes waiting_;
  std::optional<Header> header_;  ///< whose body is waited for
  std::uint64_t skip_ = 0;        ///< bytes yet to be passed over
  bool broken_ = false;
  StreamCounts counts_;
};

}  // namespace palpa::igt

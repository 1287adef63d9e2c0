#include "apps/link/igtl/wire.h"

#include <algorithm>
#include <array>

namespace palpa::igt {
namespace {

bool isRead(const Header& header) {
  static constexpr std::array kTypes{"TRANSFORM", "TDATA",      "STT_TDATA", "STP_TDATA",
                                     "RTS_TDATA", "GET_STATUS", "STATUS"};
  return header.version <= kNewestVersion &&
         std::find(kTypes.begin(), kTypes.end(), header.type) != kTypes.end();
}

}  // namespace

std::optional<Message> MessageStream::next() {
  while (!broken_) {
    const auto passed = static_cast<std::size_t>(std::min<std::uint64_t>(skip_, waiting_.size()));
    drop(passed);
    skip_ -= passed;
    if (skip_ > 0 || (!header_ && !takeHeader())) return std::nullopt;
    if (skip_ > 0 || !header_) continue;
    if (waiting_.size() < header_->body_size) return std::nullopt;
    if (auto message = takeBody()) return message;
  }
  return std::nullopt;
}

/// False: not yet whole, or no header.
bool MessageStream::takeHeader() {
  if (waiting_.size() < kHeaderSize) return false;
  header_ = readHeader(View(waiting_).first<kHeaderSize>());
  if (!header_ || header_->body_size > kLargestSkip) {
    broken_ = true;
    waiting_.clear();
    header_.reset();
    return false;
  }
  drop(kHeaderSize);
  if (header_->body_size <= kLargestBody && isRead(*header_)) return true;
  skip_ = header_->body_size;
  ++counts_.skipped;
  header_.reset();
  return true;
}

/// Nothing: it is dropped.
std::optional<Message> MessageStream::takeBody() {
  const Header header = *header_;
  header_.reset();
  const View body = View(waiting_).first(header.body_size);
  std::optional<Message> message;
  if (crcFits(header, body))
    if (auto content = contentOf(header, body))
      message = Message{header, Bytes(content->bytes.begin(), content->bytes.end()),
                        std::move(content->metadata)};
  drop(header.body_size);
  ++(message ? counts_.messages : counts_.damaged);
  return message;
}

}  // namespace palpa::igt

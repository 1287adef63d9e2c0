#include "apps/link/igtl/peer.h"

#include <array>

namespace palpa::igt {
namespace {

constexpr std::size_t kMostRequestBytes =
    64 * 1024;  // taken in one call, so that nobody who floods keeps the server

}  // namespace

void Peer::event(Bytes message) {
  if (events_.size() >= kMostEvents) {
    events_.pop_front();
    ++lost_events_;
  }
  events_.push_back(std::move(message));
}

/// Events first: a state comes again. False: nothing waits.
bool Peer::takeNext() {
  sent_ = 0;
  sending_.clear();
  if (!events_.empty()) {
    sending_ = std::move(events_.front());
    events_.pop_front();
    return true;
  }
  if (states_.empty()) return false;
  sending_ = std::move(states_.begin()->second);
  states_.erase(states_.begin());
  return true;
}

void Peer::flush(std::int64_t now_ns) {
  if (idle()) moved_ns_ = now_ns;
  while (socket_.open() && (sent_ < sending_.size() || takeNext())) {
    const std::size_t taken = socket_.send(View(sending_).subspan(sent_));
    if (taken == 0) return;
    sent_ += taken;
    moved_ns_ = now_ns;
  }
}

std::vector<Message> Peer::requests() {
  std::vector<Message> requests;
  std::array<std::uint8_t, 4096> buffer;
  for (std::size_t total = 0; total < kMostRequestBytes;) {
    const std::size_t got = socket_.receive(buffer);
    if (got == 0) break;
    total += got;
    stream_.feed(View(buffer).first(got));
    while (auto message = stream_.next()) requests.push_back(std::move(*message));
  }
  return requests;
}

}  // namespace palpa::igt

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>

namespace palpa::runtime {

/// How time passes: in threads, or step by step in one thread.
enum class TimeMode { real, virtual_time };

/// Latest-wins state from one writer to one reader.
/// Real time: a triple buffer; neither side ever waits or allocates.
/// Virtual time: a value becomes visible at the stated time, never earlier.
template <class T>
class StateChannel {
 public:
  explicit StateChannel(TimeMode mode) : mode_(mode) {}

  void publish(const T& value, std::int64_t visible_ns) {
    if (mode_ == TimeMode::virtual_time) {
      pending_.push_back({visible_ns, value});
      return;
    }
    slots_[back_] = value;
    back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// The newest visible value, or null before the first.
  const T* read(std::int64_t now_ns) {
    if (mode_ == TimeMode::virtual_time) {
      while (!pending_.empty() && pending_.front().visible_ns <= now_ns) {
        slots_[front_] = pending_.front().value;
        seen_ = true;
        pending_.pop_front();
      }
    } else if (middle_.load(std::memory_order_relaxed) & kFresh) {
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
      seen_ = true;
    }
    return seen_ ? &slots_[front_] : nullptr;
  }

 private:
  static constexpr std::uint8_t kFresh = 4, kIndex = 3;
  struct Pending {
    std::int64_t visible_ns;
    T value;
  };
  TimeMode mode_;
  std::array<T, 3> slots_{};
  std::atomic<std::uint8_t> middle_{1};
  std::uint8_t back_ = 0;    // writer's
  std::uint8_t front_ = 2;   // reader's
  bool seen_ = false;        // reader's
  std::deque<Pending> pending_;
};

}  // namespace palpa::runtime

#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <vector>

#include "haptics/latest_value.h"

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
    if (mode_ == TimeMode::real) return latest_.write({true, value});
    pending_.push_back({visible_ns, value});
    if (pending_.size() <= kMostPending) return;
    latest_.write(
        {true,
         pending_.front().value});  // nobody has read for long: it has been visible long since
    pending_.pop_front();
  }

  /// The newest visible value, or null before the first.
  const T* read(std::int64_t now_ns) {
    for (; !pending_.empty() && pending_.front().visible_ns <= now_ns; pending_.pop_front())
      latest_.write({true, pending_.front().value});
    const Slot& slot = latest_.read();
    return slot.there ? &slot.value : nullptr;
  }

 private:
  struct Slot {
    bool there = false;
    T value{};
  };
  struct Pending {
    std::int64_t visible_ns;
    T value;
  };
  /// more than a second of ticks: beyond every latency
  static constexpr std::size_t kMostPending = 1024;
  TimeMode mode_;
  haptics::LatestValue<Slot> latest_;
  std::deque<Pending> pending_;  ///< virtual time only
};

/// Events from one writer to one reader, none overwritten; a push into a full queue is counted.
/// Storage is allocated once; neither side waits.
template <class T>
class EventQueue {
 public:
  explicit EventQueue(std::size_t capacity) : slots_(capacity + 1) {}

  bool push(const T& value) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    const std::size_t next = head + 1 == slots_.size() ? 0 : head + 1;
    if (next == tail_.load(std::memory_order_acquire)) {
      overflows_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    slots_[head] = value;
    head_.store(next, std::memory_order_release);
    return true;
  }

  bool pop(T* value) {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    *value = slots_[tail];
    tail_.store(tail + 1 == slots_.size() ? 0 : tail + 1, std::memory_order_release);
    return true;
  }

  std::uint64_t overflows() const { return overflows_.load(std::memory_order_relaxed); }
  /// How many are not taken yet, at most; any thread.
  std::size_t waiting() const {
    const std::size_t tail = tail_.load(std::memory_order_acquire),
                      head = head_.load(std::memory_order_acquire);
    return head >= tail ? head - tail : head + slots_.size() - tail;
  }

 private:
  std::vector<T> slots_;
  std::atomic<std::size_t> head_{0}, tail_{0};
  std::atomic<std::uint64_t> overflows_{0};
};

}  // namespace palpa::runtime

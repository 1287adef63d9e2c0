#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace palpa::runtime {

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

 private:
  std::vector<T> slots_;
  std::atomic<std::size_t> head_{0}, tail_{0};
  std::atomic<std::uint64_t> overflows_{0};
};

}  // namespace palpa::runtime

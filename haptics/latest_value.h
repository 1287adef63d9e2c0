#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace palpa::haptics {

/// The latest value, from one writing thread to one reading thread: a triple buffer. Neither side
/// waits, nor allocates unless copying T does; a value is never torn.
template <class T>
class LatestValue {
 public:
  void write(const T& value) noexcept {
    slots_[back_] = value;
    back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// The newest value; T{} before the first.
  const T& read() noexcept {
    if (middle_.load(std::memory_order_relaxed) & kFresh)
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return slots_[front_];
  }

 private:
  static constexpr std::uint8_t kFresh = 4, kIndex = 3;
  std::array<T, 3> slots_{};
  std::atomic<std::uint8_t> middle_{1};
  std::uint8_t back_ = 0;   // writer's
  std::uint8_t front_ = 2;  // reader's
};

}  // namespace palpa::haptics

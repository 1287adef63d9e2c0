#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace palpa::haptics {

/// The latest value from one writing to one reading thread: three slots, one exchanged index.
/// Neither side ever waits or allocates. Before the first `publish` the reader sees `T{}`.
template <class T>
class Latest {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void publish(const T& value) noexcept {
    slots_[back_] = value;
    back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

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

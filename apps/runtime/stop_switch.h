#pragma once

#include <atomic>
#include <cstdint>

namespace palpa::runtime {

/// The emergency stop's own way to the haptic thread, which looks at it in every tick: no queue, no
/// lock, nothing that somebody else must do first. Whoever sees a reason presses it: any thread.
class StopSwitch {
 public:
  void press() noexcept { presses_.fetch_add(1, std::memory_order_release); }
  /// How often it was pressed so far.
  std::uint32_t presses() const noexcept { return presses_.load(std::memory_order_acquire); }
  /// After `seen` presses somebody has re-armed deliberately; one that came since still counts.
  void rearm(std::uint32_t seen) noexcept { rearmed_.store(seen, std::memory_order_release); }
  /// The session ends: no force from now on, and nobody re-arms.
  void end() noexcept { ended_.store(true, std::memory_order_release); }
  bool ended() const noexcept { return ended_.load(std::memory_order_acquire); }
  bool noForce() const noexcept {
    return ended() || presses() != rearmed_.load(std::memory_order_acquire);
  }

 private:
  std::atomic<std::uint32_t> presses_{0}, rearmed_{0};
  std::atomic<bool> ended_{false};
};

}  // namespace palpa::runtime

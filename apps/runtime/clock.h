#pragma once

#include <cstdint>

namespace palpa::runtime {

inline constexpr std::int64_t kMillisecond = 1'000'000;
inline constexpr std::int64_t kSecond = 1'000'000'000;

/// Session time in nanoseconds, 0 at the start. The only source of time in the program.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual std::int64_t now() const noexcept = 0;
  /// Session time of a stamp of CLOCK_MONOTONIC, as drivers give them; in virtual time nothing real has one: now.
  virtual std::int64_t ofMonotonic(std::int64_t) const noexcept { return now(); }
};

/// CLOCK_MONOTONIC since construction.
class SteadyClock final : public Clock {
 public:
  SteadyClock();
  std::int64_t now() const noexcept override;
  std::int64_t ofMonotonic(std::int64_t t_ns) const noexcept override { return t_ns - start_ns_; }
  /// Sleeps until session time `t_ns` (absolute, so that lateness does not add up).
  void sleepUntil(std::int64_t t_ns) const noexcept;

 private:
  std::int64_t start_ns_;
};

/// UTC of now, ns since 1970: for stamps that leave the program, never for what happens in it.
std::int64_t utcNow_ns() noexcept;

}  // namespace palpa::runtime

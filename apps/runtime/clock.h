#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace palpa::runtime {

inline constexpr std::int64_t kMillisecond = 1'000'000;
inline constexpr std::int64_t kSecond = 1'000'000'000;

/// Session time in nanoseconds, 0 at the start. The only source of time in the program.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual std::int64_t now() const noexcept = 0;
  /// Session time of a stamp of CLOCK_MONOTONIC, as drivers give them; in virtual time nothing real
  /// has one: now.
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

/// The computer's date in nanoseconds since 1970 (UTC); somebody may set it at any moment. For
/// asking how the clocks are and for stamps that leave the program, never for what happens in a
/// session.
std::int64_t dateNow() noexcept;

/// The smallest step of CLOCK_MONOTONIC, in nanoseconds.
std::int64_t clockResolution() noexcept;

/// CLOCK_MONOTONIC in the shape the standard library's waits take: for servers and sockets, which
/// live outside sessions and their clock.
struct ServingClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<ServingClock>;
  static constexpr bool is_steady = true;
  static time_point now() noexcept;
};

/// The calling thread rests this long.
void rest(std::chrono::nanoseconds time) noexcept;

/// Asks ten times a second until the answer is yes, no longer than `most`. The last answer.
bool comesTrue(std::chrono::milliseconds most, const std::function<bool()>& question);

/// How long a program that was killed may hold its locks and its port: the system takes its memory
/// and its threads apart first.
inline constexpr std::chrono::seconds kKilledLetsGo{3};

enum class Zone { utc, local };
/// The computer's date, now or then, in strftime's words.
std::string dateText(const char* pattern, Zone zone = Zone::utc,
                     std::optional<std::chrono::sys_seconds> of = std::nullopt);
/// "2026-03-01T12:30:00Z"
std::string utcNow();

}  // namespace palpa::runtime

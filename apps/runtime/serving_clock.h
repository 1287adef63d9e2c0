#pragma once

#include <chrono>
#include <string>

namespace palpa::runtime {

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

enum class Zone { utc, local };
/// The computer's date now, in strftime's words.
std::string dateText(const char* pattern, Zone zone = Zone::utc);
/// "2026-03-01T12:30:00Z": the same in full.
std::string utcNow();

}  // namespace palpa::runtime

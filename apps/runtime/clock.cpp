#include "apps/runtime/clock.h"

#include <cerrno>
#include <ctime>

namespace palpa::runtime {
namespace {
std::int64_t timeOf(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return t.tv_sec * kSecond + t.tv_nsec;
}
std::int64_t monotonic() { return timeOf(CLOCK_MONOTONIC); }
}  // namespace

std::int64_t dateNow() noexcept { return timeOf(CLOCK_REALTIME); }

std::int64_t clockResolution() noexcept {
  timespec t{};
  clock_getres(CLOCK_MONOTONIC, &t);
  return t.tv_sec * kSecond + t.tv_nsec;
}

SteadyClock::SteadyClock() : start_ns_(monotonic()) {}

std::int64_t SteadyClock::now() const noexcept { return monotonic() - start_ns_; }

void SteadyClock::sleepUntil(std::int64_t t_ns) const noexcept {
  const std::int64_t t = start_ns_ + t_ns;
  const timespec until{static_cast<time_t>(t / kSecond), static_cast<long>(t % kSecond)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

ServingClock::time_point ServingClock::now() noexcept {
  static const SteadyClock clock;
  return time_point(duration(clock.now()));
}

void rest(std::chrono::nanoseconds time) noexcept {
  const SteadyClock clock;
  clock.sleepUntil(time.count());
}

std::string dateText(const char* pattern, Zone zone) {
  const std::time_t now = static_cast<std::time_t>(dateNow() / kSecond);
  std::tm parts{};
  zone == Zone::utc ? gmtime_r(&now, &parts) : localtime_r(&now, &parts);
  char text[64];
  return {text, std::strftime(text, sizeof text, pattern, &parts)};
}

std::string utcNow() { return dateText("%Y-%m-%dT%H:%M:%SZ"); }

}  // namespace palpa::runtime

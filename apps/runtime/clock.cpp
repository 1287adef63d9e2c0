#include "apps/runtime/clock.h"

#include <ctime>

#include "anatomy/base/utc.h"
#include "apps/os/system_time.h"

namespace palpa::runtime {

std::int64_t dateNow() noexcept { return os::date_ns(); }

std::int64_t clockResolution() noexcept { return os::monotonicResolution_ns(); }

SteadyClock::SteadyClock() : start_ns_(os::monotonic_ns()) {}

std::int64_t SteadyClock::now() const noexcept { return os::monotonic_ns() - start_ns_; }

void SteadyClock::sleepUntil(std::int64_t t_ns) const noexcept {
  os::sleepUntilMonotonic(start_ns_ + t_ns);
}

ServingClock::time_point ServingClock::now() noexcept {
  static const SteadyClock clock;
  return time_point(duration(clock.now()));
}

void rest(std::chrono::nanoseconds time) noexcept {
  const SteadyClock clock;
  clock.sleepUntil(time.count());
}

bool comesTrue(std::chrono::milliseconds most, const std::function<bool()>& question) {
  constexpr std::chrono::milliseconds kBetween{100};
  for (const auto last = ServingClock::now() + most; ServingClock::now() < last; rest(kBetween))
    if (question()) return true;
  return question();
}

std::string dateText(const char* pattern, Zone zone, std::optional<std::chrono::sys_seconds> of) {
  const std::time_t then =
      static_cast<std::time_t>(of ? of->time_since_epoch().count() : dateNow() / kSecond);
  std::tm parts{};
  zone == Zone::utc ? gmtime_r(&then, &parts) : localtime_r(&then, &parts);
  char text[64];
  return {text, std::strftime(text, sizeof text, pattern, &parts)};
}

std::string utcNow() {
  return isoTime(std::chrono::sys_seconds(std::chrono::seconds(dateNow() / kSecond)));
}

}  // namespace palpa::runtime

#include "apps/runtime/serving_clock.h"

#include <ctime>

#include "apps/runtime/clock.h"

namespace palpa::runtime {

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

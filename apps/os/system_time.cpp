#include "apps/os/system_time.h"

#include <sys/timex.h>

#include <cerrno>
#include <ctime>

namespace palpa::os {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

std::int64_t nanoseconds(const timespec& t) { return t.tv_sec * kSecond + t.tv_nsec; }

std::int64_t timeOf(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return nanoseconds(t);
}

}  // namespace

std::int64_t monotonic_ns() noexcept { return timeOf(CLOCK_MONOTONIC); }

std::int64_t date_ns() noexcept { return timeOf(CLOCK_REALTIME); }

std::int64_t monotonicResolution_ns() noexcept {
  timespec t{};
  clock_getres(CLOCK_MONOTONIC, &t);
  return nanoseconds(t);
}

std::int64_t threadsProcessorTime_ns() noexcept { return timeOf(CLOCK_THREAD_CPUTIME_ID); }

std::int64_t processorTime_ns() noexcept { return timeOf(CLOCK_PROCESS_CPUTIME_ID); }

void sleepUntilMonotonic(std::int64_t t_ns) noexcept {
  const timespec until{static_cast<time_t>(t_ns / kSecond), static_cast<long>(t_ns % kSecond)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

bool dateIsKept() noexcept {
  timex asked{};  // no mode: nothing is set
  return adjtimex(&asked) != TIME_ERROR;
}

}  // namespace palpa::os

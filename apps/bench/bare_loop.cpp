#include "apps/bench/bare_loop.h"

#include <algorithm>

#include "apps/runtime/clock.h"
#include "apps/runtime/real_time.h"

namespace palpa::bench {

LoopTimes runBareLoop(std::int64_t period_ns, std::int64_t length_ns, int cpu) {
  LoopTimes times;
  const runtime::MemoryLock memory;
  times.scheduling = runtime::becomeRealTime(cpu) + "; " + memory.words();
  const runtime::SteadyClock clock;
  std::int64_t due = clock.now();
  for (const std::int64_t end = due + length_ns; due < end;) {
    clock.sleepUntil(due);
    const std::int64_t now = clock.now();
    times.late.add(now - due);
    times.missed += now - due > period_ns;
    due = std::max(due + period_ns, now);
  }
  return times;
}

}  // namespace palpa::bench

#pragma once

#include <cstdint>
#include <string>

#include "apps/runtime/time_histogram.h"

namespace palpa::bench {

/// How late a loop was, however it was made.
struct LoopTimes {
  runtime::TimeHistogram late;
  std::uint64_t missed = 0;  ///< later than one period
  std::string scheduling;
};

/// What the operating system gives: a timer loop that does nothing, asking for the same priority,
/// memory and `cpu` as the executive's real-time thread. Runs on the calling thread, whose priority
/// it changes.
LoopTimes runBareLoop(std::int64_t period_ns, std::int64_t length_ns, int cpu);

}  // namespace palpa::bench

#pragma once

#include "apps/bench/stroke.h"

namespace palpa::bench {

struct TickTiming {
  double median_us = 0, p99_us = 0;
};

/// The recorded stroke run through the tick again, as fast as it goes: mean of 16 ticks at a time.
TickTiming timeHot(const StrokeSettings& settings, const StrokeResult& stroke, int ticks);
/// The same, one tick a millisecond, each timed alone: caches have cooled in between.
TickTiming timePaced(const StrokeSettings& settings, const StrokeResult& stroke, double seconds);

}  // namespace palpa::bench

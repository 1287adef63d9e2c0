#pragma once

#include <functional>
#include <vector>

#include "apps/bench/paired.h"

namespace palpa::bench {

struct QueryTiming {
  double median_us = 0, p99_us = 0;
};

/// `ask(i)` for i = 0 .. count - 1, as fast as it goes, 16 timed at a time.
QueryTiming timeQueries(int count, const std::function<void(int)>& ask);
/// Each timed alone, after 32 MiB of other memory has been read: nothing of the mesh is in a cache.
QueryTiming timeCold(int count, const std::function<void(int)>& ask);

struct Ratio {
  double median = 0;
  Interval interval;
};
/// How many times as long b takes as a over the same queries: A B B A in turn, a ratio of times a
/// block, their median.
Ratio compareQueries(int blocks, int count, const std::function<void(int)>& a,
                     const std::function<void(int)>& b);

}  // namespace palpa::bench

#pragma once

namespace palpa::bench {

struct LoopBenchOptions {
  double seconds = 20;  ///< of measurement, in 40 segments
  double rate_Hz = 1000;
  int cpu = -1;   ///< of the measured thread; -1: any
  int pages = 0;  ///< that look on through a console, in a second measurement
};

/// How late the haptic loop's ticks are, and how late a bare timer loop of the same priority is
/// with the same beside it, in turn in 10 blocks A B B A: one JSON object a line on standard
/// output. What the ratio of the two 99 % quantiles has above 1 is ours; the rest is the machine's.
/// With `pages` the same again while so many look on.
void benchLoop(const LoopBenchOptions& options);

}  // namespace palpa::bench

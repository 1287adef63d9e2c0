#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "apps/runtime/activity.h"
#include "apps/runtime/clock.h"
#include "apps/runtime/state_channel.h"
#include "apps/runtime/time_histogram.h"

namespace palpa::runtime {

/// Lateness of an activity's steps behind their due times, and what a step cost; real time only.
struct Lateness {
  std::string name;
  std::uint64_t steps = 0;
  double median_us = 0, p99_us = 0, p999_us = 0, max_us = 0;
  Spread cost;  ///< from the step's beginning to its end, wherever the thread was meanwhile
  std::uint64_t missed_ticks =
      0;                   ///< later than one period; 0 for an activity without a steady period
  std::string scheduling;  ///< "SCHED_FIFO; memory locked", or why not
  TimeHistogram late;      ///< the lateness itself
};

/// Runs activities until one of them finishes `run` by stop(), or all are done.
class Executive {
 public:
  virtual ~Executive() = default;
  virtual TimeMode mode() const = 0;
  virtual const Clock& clock() const = 0;
  virtual void add(Activity& activity, const ThreadPolicy& policy) = 0;
  virtual void run() = 0;  ///< rethrows the first exception of an activity, after stopping all
  virtual void stop() noexcept = 0;
  virtual std::vector<Lateness> lateness() const { return {}; }
};

/// One thread, steps in order of (due, priority, order of adding). No wall clock.
std::unique_ptr<Executive> makeVirtualExecutive();
/// One thread an activity (one may run on the caller's).
std::unique_ptr<Executive> makeRealExecutive();

}  // namespace palpa::runtime

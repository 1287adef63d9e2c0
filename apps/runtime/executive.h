#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/runtime/activity.h"
#include "apps/runtime/channels.h"
#include "apps/runtime/clock.h"

namespace palpa::runtime {

/// Counts of times between 0 and 2^40 ns (18 min), in fixed bins, so that a real-time thread can
/// fill it: 1 ns wide below 256 ns, above that 128 to an octave, so that a quantile is within 0.4 %
/// of its value. Never allocates after construction.
class TimeHistogram {
 public:
  void add(std::int64_t t_ns) noexcept;  ///< below 0 counts as 0
  void add(const TimeHistogram& other) noexcept;

  /// Value in ns that the share q of all, rounded up to a whole count, does not exceed (nearest
  /// rank): the middle of its bin, at most the largest. 0 for none.
  double quantile(double q) const noexcept;
  std::uint64_t count() const noexcept { return count_; }
  std::int64_t max_ns() const noexcept { return max_ns_; }

 private:
  static constexpr int kLongest = 40, kFine = 8;  // bits
  static constexpr int kBins = (1 << kFine) + (kLongest - kFine) * (1 << (kFine - 1));
  static int binOf(std::int64_t t_ns) noexcept;
  static double middleOf(int bin) noexcept;

  std::array<std::uint32_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ns_ = 0;
};

/// What is said of a histogram, in microseconds.
struct TimeSpread {
  double median_us = 0, p99_us = 0, p999_us = 0, max_us = 0;
};
TimeSpread spreadOf(const TimeHistogram& histogram) noexcept;

/// Lateness of an activity's steps behind their due times, and what a step cost; real time only.
struct Lateness {
  std::string name;
  std::uint64_t steps = 0;
  double median_us = 0, p99_us = 0, p999_us = 0, max_us = 0;
  TimeSpread cost;  ///< from the step's beginning to its end, wherever the thread was meanwhile
  /// later than one period; 0 for an activity without a steady period
  std::uint64_t missed_ticks = 0;
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
  /// Rethrows the first exception of an activity, or Error where the system gives no thread for
  /// one, after stopping all.
  virtual void run() = 0;
  virtual void stop() noexcept = 0;
  /// What hangs in a call that does not come back would hold up the end of `run` for ever. Some
  /// seconds after a stop `giveUp` is then called, on a thread of its own, with the names of the
  /// activities whose last step is not over; all others have ended. It has to end the program;
  /// `failure`: what one of them threw before, in words, or empty. In virtual time nothing is given
  /// up.
  using Stuck = std::vector<std::string>;
  using GiveUp = std::function<void(const Stuck&, const std::string& failure)>;
  virtual void whenStuck(const GiveUp&, std::int64_t /*patience_ns*/) {}
  /// Activities whose step has lasted this long; any thread.
  virtual Stuck stuckFor(std::int64_t) const { return {}; }
  virtual std::vector<Lateness> lateness() const { return {}; }
};

/// What the steps of each activity, by name, took of the processor's time, ns.
using StepCosts = std::map<std::string, std::int64_t>;

/// One thread, steps in order of (due, priority, order of adding). No wall clock. `costs`, for
/// measurements alone: what the steps cost is added there; every step then costs a look at a clock.
std::unique_ptr<Executive> makeVirtualExecutive(StepCosts* costs = nullptr);
/// One thread an activity (one may run on the caller's).
std::unique_ptr<Executive> makeRealExecutive();

}  // namespace palpa::runtime

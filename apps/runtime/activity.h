#pragma once

#include <cstdint>
#include <limits>

namespace palpa::runtime {

inline constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// One deterministic step at a time: `step(now)` does what is due and says when it is due next.
class Activity {
 public:
  virtual ~Activity() = default;
  virtual const char* name() const = 0;
  virtual std::int64_t step(std::int64_t now_ns) = 0;  ///< next due time; kNever: finished
  virtual void end() noexcept {}  ///< its last step is over, whatever ended it; on its own thread
  /// Of a steady step; 0: none, none can be missed
  virtual std::int64_t period_ns() const { return 0; }
};

/// How a thread runs an activity in real time.
struct ThreadPolicy {
  int priority = 0;        ///< fixed order at equal due times in virtual time: smaller first
  bool real_time = false;  ///< SCHED_FIFO where allowed, the process kept in memory
  bool on_caller = false;  ///< run on the calling thread (windows want the main thread)
  int cpu = -1;            ///< of a real-time thread: the only one it may run on; -1: any
};

}  // namespace palpa::runtime

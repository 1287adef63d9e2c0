#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/runtime/bus.h"
#include "apps/runtime/executive.h"
#include "haptics/flight_record.h"

namespace palpa::trial {

/// Whether this computer keeps up with a session in real time, by what the task sees anyway: how
/// late every tick was, how many frames the scene has shown, how far the evidence is behind.
///
/// The rehearsal is the first two seconds of ticks. What it finds is said before the first trial
/// and forbids none; what happens in a trial is counted for it.
class LoadWatch {
 public:
  static constexpr std::int64_t kRehearsal_ns = 2 * runtime::kSecond;

  /// Since the session's start, except `waiting`.
  struct Seen {
    std::uint64_t frames = 0;   ///< of the scene
    std::uint64_t lost = 0;     ///< records
    std::uint64_t waiting = 0;  ///< ticks not yet in the evidence
  };
  static Seen seenOn(const runtime::Bus& bus, std::uint64_t frames);

  void tick(const haptics::FlightRecord& record);
  void look(const Seen& seen);  ///< after the ticks, as often as the task steps
  bool rehearsed() const { return newest_ns_ - first_ns_ >= kRehearsal_ns; }

  /// What the computer cannot do, and what to do about it.
  struct Verdict {
    std::string what, remedy;
  };
  std::vector<Verdict> verdicts() const;  ///< of the rehearsal; empty: it keeps up

  void beginTrial() { trial_missed_ = missed_, trial_lost_ = seen_.lost; }
  /// Of the trial that has begun last: ticks later than a period, records that are nowhere.
  std::uint64_t missed() const { return missed_ - trial_missed_; }
  std::uint64_t lost() const { return seen_.lost - trial_lost_; }

 private:
  runtime::TimeHistogram late_;  ///< of the rehearsal
  Seen seen_, begin_;            ///< now; with the first tick
  std::uint64_t most_waiting_ = 0, frames_ = 0, missed_ = 0, trial_missed_ = 0, trial_lost_ = 0;
  std::int64_t first_ns_ = 0, newest_ns_ = 0, due_ns_ = 0;
  std::int64_t period_ns_ = runtime::kMillisecond;  ///< of the ticks; none is longer
  bool begun_ = false, looked_ = false;
};

}  // namespace palpa::trial

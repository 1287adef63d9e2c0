#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "apps/runtime/flight_sink.h"

namespace palpa::record {

/// What has been handed over since the last commit. It is kept until a commit has succeeded, so
/// that a full disk or a lock costs nothing once it is gone.
struct Pending {
  std::vector<runtime::TrialHeader> begun;
  std::vector<runtime::TrialEnd> ended;
  std::vector<runtime::Event> events;
  std::vector<haptics::FlightRecord> ticks;
  std::vector<LocalGeometry> snapshots;
  std::vector<std::pair<std::int64_t, haptics::TickState>> keyframes;

  bool empty() const {
    return begun.empty() && ended.empty() && events.empty() && ticks.empty() && snapshots.empty() &&
           keyframes.empty();
  }
  /// So many ticks have been written, and all the rest. Keeps the memory for the next 200 ticks.
  void clear(std::size_t ticks_written) {
    begun.clear();
    ended.clear();
    events.clear();
    ticks.erase(ticks.begin(), ticks.begin() + static_cast<std::ptrdiff_t>(ticks_written));
    snapshots.clear();
    keyframes.clear();
  }
};

}  // namespace palpa::record

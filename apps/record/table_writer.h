#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/record/sqlite.h"
#include "apps/runtime/flight_sink.h"

namespace palpa::record {

/// What has been handed over since the last commit. It is kept until a commit has succeeded, so
/// that a full disk or a lock costs nothing once it is gone.
struct PendingRows {
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

/// Rows into the tables of schema.h, each with its checksum. Call within a Transaction.
class TableWriter {
 public:
  explicit TableWriter(Database& database);

  void meta(std::string_view key, std::string_view text);
  void meta(std::string_view key, ByteView bytes);
  void trial(const runtime::TrialHeader& header);
  void trialEnd(const runtime::TrialEnd& end);
  void event(const runtime::Event& event);
  void ticks(std::span<const haptics::FlightRecord> records);  ///< in chunks of at most 200
  void snapshot(const LocalGeometry& geometry);
  void keyframe(std::int64_t tick, const haptics::TickState& state);

 private:
  Statement meta_, trial_, trial_end_, event_, ticks_, snapshot_, keyframe_;
};

}  // namespace palpa::record

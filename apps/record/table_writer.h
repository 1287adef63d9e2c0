#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "apps/record/sqlite.h"
#include "apps/runtime/flight_sink.h"

namespace palpa::record {

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

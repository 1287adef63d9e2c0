#include "apps/record/table_writer.h"

#include <algorithm>

#include "apps/record/record_codec.h"
#include "apps/record/schema.h"

namespace palpa::record {
namespace {

Bytes packOne(ByteView record) { return packRecords(record, record.size()); }

}  // namespace

TableWriter::TableWriter(Database& database)
    : meta_(database, "INSERT INTO meta VALUES(?,?,?)"),
      trial_(database,
             "INSERT INTO trials(trial,t_ns,seed,role,force_feedback,puncture_force_N,crc) "
             "VALUES(?,?,?,?,?,?,?)"),
      trial_end_(database,
                 "UPDATE trials SET end_t_ns=?,outcome=?,reason=?,scores_json=?,end_crc=? "
                 "WHERE trial=?"),
      event_(database, "INSERT INTO events(t_ns,trial,kind,text,value,crc) VALUES(?,?,?,?,?,?)"),
      ticks_(database, "INSERT INTO ticks VALUES(?,?,?,?,?)"),
      snapshot_(database, "INSERT INTO snapshots VALUES(?,?,?,?)"),
      keyframe_(database, "INSERT INTO keyframes VALUES(?,?,?)") {}

void TableWriter::meta(std::string_view key, std::string_view text) {
  meta_.bind(key, text, rowChecksum(key, text)).run();
}

void TableWriter::meta(std::string_view key, ByteView bytes) {
  meta_.bind(key, bytes, rowChecksum(key, bytes)).run();
}

void TableWriter::trial(const runtime::TrialHeader& header) {
  const auto seed = static_cast<std::int64_t>(header.seed);
  const int force_feedback = header.force_feedback ? 1 : 0;
  trial_
      .bind(header.trial, header.t_ns, seed, header.role, force_feedback, header.puncture_force_N,
            rowChecksum(header.trial, header.t_ns, seed, std::string_view(header.role),
                        force_feedback, header.puncture_force_N))
      .run();
}

void TableWriter::trialEnd(const runtime::TrialEnd& end) {
  trial_end_
      .bind(end.t_ns, end.outcome, end.reason, end.scores_json,
            rowChecksum(end.trial, end.t_ns, std::string_view(end.outcome),
                        std::string_view(end.reason), std::string_view(end.scores_json)),
            end.trial)
      .run();
}

void TableWriter::event(const runtime::Event& event) {
  event_
      .bind(event.t_ns, event.trial, event.kind, event.text, event.value,
            rowChecksum(event.t_ns, event.trial, std::string_view(event.kind),
                        std::string_view(event.text), event.value))
      .run();
}

void TableWriter::ticks(std::span<const haptics::FlightRecord> records) {
  constexpr std::size_t kSize = sizeof(haptics::FlightRecord);
  while (!records.empty()) {
    const auto chunk = records.first(std::min(records.size(), kChunkTicks));
    const Bytes blob = packRecords(bytesOf(chunk.data(), chunk.size()), kSize);
    const auto count = static_cast<std::int64_t>(chunk.size());
    const auto size = static_cast<std::int64_t>(kSize);
    const std::int64_t first = chunk.front().tick;
    ticks_.bind(first, count, size, ByteView(blob), rowChecksum(first, count, size, ByteView(blob)))
        .run();
    records = records.subspan(chunk.size());
  }
}

void TableWriter::snapshot(const LocalGeometry& geometry) {
  const Bytes blob = packOne(bytesOf(&geometry, 1));
  const auto number = static_cast<std::int64_t>(geometry.number);
  snapshot_
      .bind(number, geometry.t_ns, ByteView(blob),
            rowChecksum(number, geometry.t_ns, ByteView(blob)))
      .run();
}

void TableWriter::keyframe(std::int64_t tick, const haptics::TickState& state) {
  const Bytes blob = packOne(bytesOf(&state, 1));
  keyframe_.bind(tick, ByteView(blob), rowChecksum(tick, ByteView(blob))).run();
}

}  // namespace palpa::record

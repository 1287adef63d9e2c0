
#include <map>
#include <optional>
#include <span>

#include "anatomy/base/uuid.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "apps/record/schema.h"
#include "apps/record/session_file.h"
#include "apps/record/table_writer.h"

namespace palpa::record {
namespace {

/// Claims the name: evidence is never overwritten, not even by two processes at once.
void createEmpty(const std::filesystem::path& file) {
  const std::error_code problem = os::createNew(file);
  if (problem == std::errc::file_exists)
    throw Error("a file of this name already exists; evidence is never overwritten", file.string(),
                "Choose another folder with --out");
  if (problem) failFile("cannot be created", file, problem, "Or choose another folder with --out");
}

void removeAll(const std::filesystem::path& file) noexcept {
  std::error_code ignored;
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
    std::filesystem::remove(file.string() + suffix, ignored);
  }
}

void setUp(Database& database) {
  if (database.text("PRAGMA journal_mode=WAL") != "wal") {
    throw Error("this disk allows no write-ahead log", database.file().string(),
                "Choose a folder on a local disk with --out");
  }
  database.exec("PRAGMA synchronous=NORMAL");
  // Merge the log every 16 MB instead of every 4: fewer waits for the disk while recording.
  database.exec("PRAGMA wal_autocheckpoint=4000");
}

void makeTables(Database& database) {
  database.exec("PRAGMA application_id=" + std::to_string(kApplicationId));
  database.exec("PRAGMA user_version=" + std::to_string(kSchemaVersion));
  database.exec(schemaSql());
}

void writeInfo(TableWriter& tables, const SessionInfo& info) {
  tables.meta("layout", layoutText());
  tables.meta("uuid", info.uuid.empty() ? newUuid() : info.uuid);
  tables.meta("started_utc", info.started_utc);
  tables.meta("software", info.software);
  tables.meta("command", info.command);
  tables.meta("session_json", info.session_json);
  tables.meta("station_json", info.station_json);
  tables.meta("task_json", info.task_json);
  tables.meta("expert_path_json", info.expert_path_json);
  tables.meta("patient_glb", bytesOf(info.patient_glb.data(), info.patient_glb.size()));
  tables.meta("tick_config", bytesOf(&info.tick_config, 1));
  tables.meta("pair_config", info.pair_config ? bytesOf(&*info.pair_config, 1) : ByteView());
}

}  // namespace

struct SessionWriter::Impl {
  explicit Impl(const std::filesystem::path& path) : file(path) {}

  void create(const SessionInfo& info);
  void commit(bool closing = false);
  void close();
  void checkOpen() const {
    if (!tables) refuse("is closed already");
  }
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(what, file.string(), "This is a fault of the program: report it");
  }

  std::filesystem::path file;
  std::optional<Database> database;
  std::optional<TableWriter> tables;
  PendingRows pending;
  bool paired = false;                                            ///< two records a tick
  std::map<int, bool> trials;                                     ///< trial -> ended
  std::pair<std::int64_t, std::uint8_t> last_tick{INT64_MIN, 0};  ///< and its tool
  std::int64_t last_keyframe = INT64_MIN;
  std::optional<std::uint64_t> last_snapshot;
};

void SessionWriter::Impl::create(const SessionInfo& info) {
  createEmpty(file);
  try {
    database.emplace(file, Database::Mode::write);
    setUp(*database);
    paired = info.pair_config.has_value();
    Transaction transaction(*database);  // whoever is killed here leaves all of it, or nothing
    makeTables(*database);
    tables.emplace(*database);
    writeInfo(*tables, info);
    transaction.commit();
  } catch (...) {
    tables.reset();
    database.reset();
    removeAll(file);
    throw;
  }
}

/// A tick's two records stay together: the first waits for the second, unless there will be none.
void SessionWriter::Impl::commit(bool closing) {
  checkOpen();
  if (pending.empty()) return;
  const bool waits = paired && !closing && !pending.ticks.empty() && pending.ticks.back().tool == 0;
  const std::size_t whole = pending.ticks.size() - (waits ? 1 : 0);
  Transaction transaction(*database);
  for (const auto& header : pending.begun) tables->trial(header);
  for (const auto& end : pending.ended) tables->trialEnd(end);
  for (const auto& event : pending.events) tables->event(event);
  tables->ticks(std::span<const haptics::FlightRecord>(pending.ticks).first(whole));
  for (const auto& geometry : pending.snapshots) tables->snapshot(geometry);
  for (const auto& [tick, state] : pending.keyframes) tables->keyframe(tick, state);
  transaction.commit();
  pending.clear(whole);
}

void SessionWriter::Impl::close() {
  if (!tables) return;
  commit(true);
  tables.reset();  // no statement may be open
  if (database->integer("PRAGMA wal_checkpoint(TRUNCATE)") == 0) {
    // A closed session is one plain file: reading it later makes no files beside it. Somebody who
    // reads it right now keeps the log in use; then SQLite tidies up when the last reader leaves.
    try {
      database->exec("PRAGMA journal_mode=DELETE");
    } catch (const DatabaseError&) {
    }
  }
  database.reset();
}

SessionWriter::SessionWriter(const std::filesystem::path& file, const SessionInfo& info)
    : impl_(std::make_unique<Impl>(file)) {
  impl_->create(info);
}

SessionWriter::~SessionWriter() {
  try {
    impl_->close();
  } catch (...) {  // close() is there to be called by those who want to know
  }
}

void SessionWriter::beginTrial(const runtime::TrialHeader& header) {
  impl_->checkOpen();
  if (!impl_->trials.emplace(header.trial, false).second) {
    impl_->refuse("trial " + std::to_string(header.trial) + " began twice");
  }
  impl_->pending.begun.push_back(header);
}

void SessionWriter::endTrial(const runtime::TrialEnd& end) {
  impl_->checkOpen();
  const auto trial = impl_->trials.find(end.trial);
  if (trial == impl_->trials.end() || trial->second) {
    impl_->refuse("trial " + std::to_string(end.trial) + " ended without having begun, or twice");
  }
  trial->second = true;
  impl_->pending.ended.push_back(end);
}

void SessionWriter::snapshot(const LocalGeometry& geometry) {
  impl_->checkOpen();
  if (impl_->last_snapshot == geometry.number) return;  // the same one, seen again
  if (impl_->last_snapshot > geometry.number) {
    impl_->refuse("snapshot " + std::to_string(geometry.number) + " came out of order");
  }
  impl_->last_snapshot = geometry.number;
  impl_->pending.snapshots.push_back(geometry);
}

void SessionWriter::tick(const haptics::FlightRecord& record) {
  impl_->checkOpen();
  if (std::pair(record.tick, record.tool) <= impl_->last_tick) {
    impl_->refuse("tick " + std::to_string(record.tick) + " came out of order");
  }
  impl_->last_tick = {record.tick, record.tool};
  impl_->pending.ticks.push_back(record);
  if (impl_->pending.ticks.size() % kChunkTicks == 0) impl_->commit();
}

void SessionWriter::keyframe(std::int64_t tick, const haptics::TickState& state) {
  impl_->checkOpen();
  if (tick <= impl_->last_keyframe) {
    impl_->refuse("keyframe " + std::to_string(tick) + " came out of order");
  }
  impl_->last_keyframe = tick;
  impl_->pending.keyframes.emplace_back(tick, state);
}

void SessionWriter::event(const runtime::Event& event) {
  impl_->checkOpen();
  impl_->pending.events.push_back(event);
}

void SessionWriter::commit() { impl_->commit(); }

void SessionWriter::close() { impl_->close(); }

}  // namespace palpa::record

#include <algorithm>
#include <cstring>

#include "apps/record/evidence.h"
#include "apps/record/record_codec.h"
#include "apps/record/schema.h"
#include "apps/record/session_file.h"

namespace palpa::record {
namespace {

/// A tampered count must not lead a reader outside the arrays, nor a byte that is no bool into one.
bool isSound(const LocalGeometry& geometry) {
  if (geometry.bone_count < 0 || geometry.bone_count > LocalGeometry::kMaxBones) return false;
  if (geometry.boundary_count < 0 || geometry.boundary_count > LocalGeometry::kMaxBoundaries) {
    return false;
  }
  for (const Boundary& boundary : geometry.boundaries) {
    unsigned char leaving = 0;
    std::memcpy(&leaving, &boundary.leaving, 1);
    if (leaving > 1) return false;
  }
  return true;
}

bool isSound(const haptics::TickState& state) { return isSound(state.now) && isSound(state.old); }

}  // namespace

struct SessionReader::Impl {
  explicit Impl(const std::filesystem::path& path) : file(path), evidence(path) {}

  void readInfo();
  std::int64_t lastTick_ns();
  void checkPages();
  Statement query(const std::string& sql);
  void check(bool sound, const char* table, std::int64_t row) const;
  template <typename Record>
  Record unpackOne(ByteView blob, const char* table, std::int64_t row) const;

  std::filesystem::path file;
  Evidence evidence;
  SessionInfo info;
  bool pages_checked = false;
};

void SessionReader::Impl::check(bool sound, const char* table, std::int64_t row) const {
  if (sound) return;
  throw Error("table " + std::string(table) + ", row " + std::to_string(row) + " is damaged",
              file.string(), "Restore the file from a backup");
}

/// SQLite's own check of pages and order, once, before the first data are read.
void SessionReader::Impl::checkPages() {
  if (pages_checked) return;
  if (evidence.database().text("PRAGMA quick_check(1)") != "ok") {
    throw Error("is damaged (its pages contradict each other)", file.string(),
                "Restore it from a backup, or save what is left with `sqlite3 FILE .recover`");
  }
  pages_checked = true;
}

Statement SessionReader::Impl::query(const std::string& sql) {
  checkPages();
  return {evidence.database(), sql};
}

template <typename Record>
Record SessionReader::Impl::unpackOne(ByteView blob, const char* table, std::int64_t row) const {
  const auto bytes = unpackRecords(blob, sizeof(Record), 1);
  check(bytes.has_value(), table, row);
  Record record;
  std::memcpy(static_cast<void*>(&record), bytes->data(), sizeof(Record));
  check(isSound(record), table, row);
  return record;
}

void SessionReader::Impl::readInfo() {
  Statement row(evidence.database(), "SELECT value, crc FROM meta WHERE key=?");
  const auto value = [&](const std::string& key, bool binary) {
    const bool found = row.bind(key).step();
    const ByteView bytes = found ? row.blob(0) : ByteView();
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::int64_t sum = binary ? rowChecksum(std::string_view(key), bytes)
                                    : rowChecksum(std::string_view(key), text);
    if (!found || row.integer(1) != sum) {
      throw Error("table meta, row " + key + " is missing or damaged", file.string(),
                  "Restore the file from a backup");
    }
    return std::string(text);
  };
  const std::string layout = value("layout", false);
  if (layout != layoutText()) {
    throw Error("holds records of another layout (" + layout + "; known: " + layoutText() + ")",
                file.string(), "Open it with the version of Palpa that wrote it");
  }
  info.uuid = value("uuid", false);
  info.started_utc = value("started_utc", false);
  info.software = value("software", false);
  info.command = value("command", false);
  info.session_json = value("session_json", false);
  info.station_json = value("station_json", false);
  info.task_json = value("task_json", false);
  info.expert_path_json = value("expert_path_json", false);
  info.patient_glb = value("patient_glb", true);
  const std::string config = value("tick_config", true);
  check(config.size() == sizeof(info.tick_config), "meta", 0);
  std::memcpy(static_cast<void*>(&info.tick_config), config.data(), config.size());
  const std::string pair = value("pair_config", true);  // empty: one device
  if (pair.empty()) return;
  check(pair.size() == sizeof(haptics::PairConfig), "meta", 0);
  std::memcpy(static_cast<void*>(&info.pair_config.emplace()), pair.data(), pair.size());
}

/// Session time of the last tick that was recorded; 0: none was, or it is damaged, which whoever
/// reads the ticks is told.
std::int64_t SessionReader::Impl::lastTick_ns() {
  constexpr std::size_t kSize = sizeof(haptics::FlightRecord);
  Statement row =
      query("SELECT count,record_size,blob FROM ticks ORDER BY first_tick DESC LIMIT 1");
  if (!row.step()) return 0;
  const std::int64_t count = row.integer(0);
  if (row.integer(1) != kSize || count < 1 || count > static_cast<std::int64_t>(kChunkTicks))
    return 0;
  const auto bytes = unpackRecords(row.blob(2), kSize, static_cast<std::size_t>(count));
  if (!bytes) return 0;
  haptics::FlightRecord last;
  std::memcpy(static_cast<void*>(&last), bytes->data() + (count - 1) * kSize, kSize);
  return last.t_ns;
}

SessionReader::SessionReader(const std::filesystem::path& file)
    : impl_(std::make_unique<Impl>(file)) {
  impl_->readInfo();
}

SessionReader::~SessionReader() = default;

const SessionInfo& SessionReader::info() const { return impl_->info; }

std::vector<RecordedTrial> SessionReader::trials() const {
  Statement row = impl_->query(
      "SELECT trial,t_ns,seed,role,force_feedback,puncture_force_N,crc,"
      "end_t_ns,outcome,reason,scores_json,end_crc FROM trials ORDER BY trial");
  std::vector<RecordedTrial> trials;
  while (row.step()) {
    RecordedTrial trial;
    runtime::TrialHeader& h = trial.header;
    h = {static_cast<int>(row.integer(0)),
         row.integer(1),
         static_cast<std::uint64_t>(row.integer(2)),
         row.text(3),
         row.integer(4) != 0,
         row.real(5)};
    impl_->check(
        row.integer(6) == rowChecksum(row.integer(0), h.t_ns, row.integer(2),
                                      std::string_view(h.role), row.integer(4), h.puncture_force_N),
        "trials", h.trial);
    trial.ended = !row.isNull(11);
    if (trial.ended) {
      runtime::TrialEnd& e = trial.end;
      e = {h.trial, row.integer(7), row.text(8), row.text(9), row.text(10)};
      impl_->check(row.integer(11) ==
                       rowChecksum(row.integer(0), e.t_ns, std::string_view(e.outcome),
                                   std::string_view(e.reason), std::string_view(e.scores_json)),
                   "trials", h.trial);
    } else {
      impl_->check(row.isNull(7) && row.isNull(8), "trials", h.trial);
      trial.end.t_ns = std::max(impl_->lastTick_ns(), h.t_ns);
    }
    trials.push_back(std::move(trial));
  }
  return trials;
}

std::vector<runtime::Event> SessionReader::events() const {
  Statement row = impl_->query("SELECT id,t_ns,trial,kind,text,value,crc FROM events ORDER BY id");
  std::vector<runtime::Event> events;
  while (row.step()) {
    runtime::Event e{row.integer(1), static_cast<int>(row.integer(2)), row.text(3), row.text(4),
                     row.real(5)};
    impl_->check(row.integer(6) == rowChecksum(e.t_ns, row.integer(2), std::string_view(e.kind),
                                               std::string_view(e.text), e.value),
                 "events", row.integer(0));
    events.push_back(std::move(e));
  }
  return events;
}

void SessionReader::ticks(const std::function<void(const haptics::FlightRecord&)>& visit) const {
  constexpr auto kSize = static_cast<std::int64_t>(sizeof(haptics::FlightRecord));
  Statement row =
      impl_->query("SELECT first_tick,count,record_size,blob,crc FROM ticks ORDER BY first_tick");
  while (row.step()) {
    const std::int64_t first = row.integer(0), count = row.integer(1), size = row.integer(2);
    const ByteView blob = row.blob(3);
    impl_->check(row.integer(4) == rowChecksum(first, count, size, blob), "ticks", first);
    impl_->check(size == kSize && count >= 1 && count <= static_cast<std::int64_t>(kChunkTicks),
                 "ticks", first);
    const auto bytes = unpackRecords(blob, kSize, static_cast<std::size_t>(count));
    impl_->check(bytes.has_value(), "ticks", first);
    haptics::FlightRecord record;
    for (std::int64_t i = 0; i < count; ++i) {
      std::memcpy(static_cast<void*>(&record), bytes->data() + i * kSize, kSize);
      impl_->check(i > 0 || record.tick == first, "ticks", first);
      visit(record);
    }
  }
}

void SessionReader::snapshots(const std::function<void(const LocalGeometry&)>& visit) const {
  Statement row = impl_->query("SELECT number,t_ns,blob,crc FROM snapshots ORDER BY number");
  while (row.step()) {
    const std::int64_t number = row.integer(0);
    impl_->check(row.integer(3) == rowChecksum(number, row.integer(1), row.blob(2)), "snapshots",
                 number);
    const auto geometry = impl_->unpackOne<LocalGeometry>(row.blob(2), "snapshots", number);
    impl_->check(static_cast<std::int64_t>(geometry.number) == number, "snapshots", number);
    visit(geometry);
  }
}

void SessionReader::keyframes(
    const std::function<void(std::int64_t, const haptics::TickState&)>& visit) const {
  Statement row = impl_->query("SELECT tick,blob,crc FROM keyframes ORDER BY tick");
  while (row.step()) {
    const std::int64_t tick = row.integer(0);
    impl_->check(row.integer(2) == rowChecksum(tick, row.blob(1)), "keyframes", tick);
    visit(tick, impl_->unpackOne<haptics::TickState>(row.blob(1), "keyframes", tick));
  }
}

void walkTrials(const SessionReader& reader, const std::vector<RecordedTrial>& trials,
                const TrialVisitor& visitor) {
  auto trial = trials.begin();
  const auto begin = [&] {
    if (trial != trials.end()) visitor.begin(*trial);
  };
  const auto finish = [&] {
    visitor.finish(*trial);
    ++trial;
    begin();
  };
  begin();
  reader.ticks([&](const haptics::FlightRecord& record) {
    while (trial != trials.end() &&
           record.commands.trial > static_cast<std::uint32_t>(trial->header.trial))
      finish();
    if (trial != trials.end() && !trial->isOver(record.t_ns)) visitor.tick(record);
  });
  while (trial != trials.end()) finish();
}

std::map<int, training::TrialTimes> trialTimes(
    const SessionReader& reader, const std::function<void(const haptics::FlightRecord&)>& visit) {
  std::map<int, training::TrialTimes> all;
  auto now = all.end();
  const auto begin = [&](const RecordedTrial& one) {
    now = all.try_emplace(one.header.trial).first;
  };
  const auto tick = [&](const haptics::FlightRecord& record) {
    if (record.commands.trial != static_cast<std::uint32_t>(now->first)) return;
    now->second.add(record.t_ns, record.commands.armed);
    if (visit && record.commands.armed) visit(record);
  };
  walkTrials(reader, reader.trials(), {begin, tick, [](const RecordedTrial&) {}});
  return all;
}

}  // namespace palpa::record

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"
#include "apps/bench/bench.h"
#include "apps/bench/empty_records.h"
#include "apps/bench/room/room_rig.h"
#include "apps/bench/timing.h"
#include "apps/runtime/clock.h"

namespace palpa::bench {
namespace {

constexpr int kRoomResamples = 2000;
constexpr std::uint64_t kRoomBootstrapSeed = 1;
constexpr char kTrainee[] = "B00001";

/// What is killed in turn while sessions run in the room: every station, the broker among them.
class RoomKills {
 public:
  RoomKills(RoomRig& rig, int turns) : rig_(rig), turns_(turns) {}

  /// Those of one turn, evenly over its `seconds`; until `over` they go on.
  void during(double seconds, const std::function<bool()>& over) {
    const int last = (turn_ + 1) * rig_.stations() / turns_;
    std::vector<std::function<void()>> kills;
    for (; next_ < last; ++next_) kills.emplace_back([this, i = next_] { kill(i); });
    if (turn_ == turns_ / 2) {
      const auto middle = static_cast<std::ptrdiff_t>(kills.size() / 2);
      kills.insert(kills.begin() + middle, [this] {
        rig_.killBroker();
        ++brokers_;
      });
    }
    ++turn_;
    const std::chrono::duration<double> apart(seconds / static_cast<double>(kills.size() + 1));
    auto due = runtime::ServingClock::now() + apart;
    for (auto& one : kills) {
      while (runtime::ServingClock::now() < due && !over())
        runtime::rest(std::chrono::milliseconds(50));
      one();
      due += apart;
    }
  }
  int stations() const { return killed_; }
  int off() const { return off_; }
  int brokers() const { return brokers_; }

 private:
  /// Of every other one the whole computer; the session in real time is what is measured, and
  /// stays.
  void kill(int station) {
    const bool off = station % 2 == 0 && !rig_.holdsRealSession(station);
    rig_.killStation(station, off);
    ++killed_;
    off_ += off;
  }
  RoomRig& rig_;
  const int turns_;
  int turn_ = 0, next_ = 0, killed_ = 0, off_ = 0, brokers_ = 0;
};

struct RoomLateness {
  std::vector<double> p99_us;  ///< one a session
  double missed = 0, ticks = 0;
  std::string scheduling;
};

class RoomMeasurement {
 public:
  RoomMeasurement(const RoomBenchOptions& options, RoomRig& rig)
      : options_(options), rig_(rig), kills_(rig, 2 * options.blocks) {}

  void run() {
    std::uint64_t seed = 0;
    bool gathered = false;
    for (const Turn turn : abbaOrder(options_.blocks)) {
      const bool in_room = turn == Turn::a;
      if (in_room) rig_.gather();
      if (!in_room && gathered) rig_.disperse();
      gathered = in_room;
      hold(turn, 1 + seed++ / 2);
      if (seed % 4 == 0) endBlock();
    }
  }
  void print(nlohmann::json params) const {
    params["blocks"] = options_.blocks;
    params["order"] = "ABBA";
    params["seconds"] = options_.seconds;
    for (const Turn turn : {Turn::a, Turn::b}) {
      const RoomLateness& late = of(turn);
      params["room"] = turn == Turn::a;
      params["sessions"] = late.p99_us.size();
      params["ticks"] = late.ticks;
      params["scheduling"] = late.scheduling;
      bench::print("lateness_p99", median(late.p99_us), "us", params);
      bench::print("missed_ticks", late.missed, "1", params);
    }
    for (const char* of_each : {"room", "sessions", "ticks", "scheduling"}) params.erase(of_each);
    params["ratios"] = ratios_;
    params["interval"] = "95 % bootstrap of the median";
    params["resamples"] = kRoomResamples;
    const ConfidenceInterval interval =
        bootstrapMedian(ratios_, kRoomResamples, kRoomBootstrapSeed);
    bench::print("lateness_ratio_p99", median(ratios_), "1", params);
    bench::print("lateness_ratio_p99_low", interval.low, "1", params);
    bench::print("lateness_ratio_p99_high", interval.high, "1", params);
  }
  const RoomKills& kills() const { return kills_; }

 private:
  RoomLateness& of(Turn turn) { return late_[static_cast<std::size_t>(turn)]; }
  const RoomLateness& of(Turn turn) const { return late_[static_cast<std::size_t>(turn)]; }

  void hold(Turn turn, std::uint64_t seed) {
    constexpr std::chrono::seconds kBeginsAndEnds{180};
    rig_.beginSession(seed, turn == Turn::a);
    const auto over = [this] { return rig_.lateness().has_value(); };
    if (turn == Turn::a) kills_.during(options_.seconds, over);
    const auto most = std::chrono::seconds(std::llround(options_.seconds)) + kBeginsAndEnds;
    if (!runtime::comesTrue(most, over))
      throw Error("did not end", "the session in real time",
                  "Run palpa subclavian --operator expert to see why");
    const nlohmann::json result = *rig_.lateness();
    RoomLateness& late = of(turn);
    late.p99_us.push_back(result["p99_us"]);
    late.missed += result["missed"].get<double>();
    late.ticks += result["ticks"].get<double>();
    late.scheduling = result["scheduling"];
  }
  void endBlock() {
    const auto lastTwo = [](const std::vector<double>& all) {
      return all[all.size() - 2] + all[all.size() - 1];
    };
    const double alone = lastTwo(of(Turn::b).p99_us);
    ratios_.push_back(alone > 0 ? lastTwo(of(Turn::a).p99_us) / alone
                                : std::numeric_limits<double>::quiet_NaN());
  }

  const RoomBenchOptions options_;
  RoomRig& rig_;
  RoomKills kills_;
  std::array<RoomLateness, 2> late_;
  std::vector<double> ratios_;
};

void printTally(const RoomTally& tally, const RoomKills& kills, nlohmann::json params) {
  params["stations_killed"] = kills.stations();
  params["computers_switched_off"] = kills.off();
  params["broker_killed"] = kills.brokers();
  params["session_files"] = tally.records;
  params["session_files_cut_off"] = tally.cut_off;
  const std::pair<const char*, std::int64_t> counts[] = {
      {"events_recorded", tally.recorded},       {"events_arrived", tally.arrived},
      {"events_missing", tally.missing},         {"events_doubled", tally.doubled},
      {"events_out_of_order", tally.disordered}, {"events_changed", tally.changed},
      {"events_beyond_records", tally.beyond}};
  for (const auto& [metric, count] : counts) print(metric, static_cast<double>(count), "1", params);
}

}  // namespace

void benchRoom(const RoomBenchOptions& options) {
  EmptyRecords records(options.records);
  const std::string now = runtime::utcNow();
  records.store.addTrainee({kTrainee, "novice", "", "right", now, now, "", ""});
  RoomRig rig({options.stations, options.seconds, records.place, kTrainee});
  const nlohmann::json params{
      {"data", "simulated"}, {"stations", options.stations}, {"store", records.kind()}};
  RoomMeasurement measurement(options, rig);
  measurement.run();
  measurement.print(params);
  printTally(rig.tellTheRest(), measurement.kills(), params);
  print("trials_in_records", static_cast<double>(records.store.trials().size()), "1", params);
}

}  // namespace palpa::bench

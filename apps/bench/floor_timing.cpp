#include "apps/bench/search_floor.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "anatomy/base/quantile.h"
#include "anatomy/base/random.h"
#include "apps/runtime/clock.h"
#include "apps/station/assets.h"
#include "haptics/loop/tick.h"

namespace palpa::bench {
namespace {

constexpr double kWholeTurn = 2 * std::numbers::pi;
constexpr double kOrientation = 0.4;                             // rad
constexpr double kPress = 0.5;                                   // N [chosen] light exploration
constexpr double kRoundHz = 0.8, kAcrossHz = 1.7, kAcross = 35;  // U
constexpr int kPathTicks = 10'000;  // 10 s: 8 rounds, 17 times across, and it is where it began
constexpr int kBlockOfLooks = 1000;
constexpr double kDeepestLook = 8;  // U

haptics::TickConfig floorConfig(const task_search::SearchSettings& task,
                                const station::Station& station) {
  haptics::TickConfig config;
  config.contact_mode = haptics::ContactMode::floor;
  config.coupling = station.coupling;
  config.safety = station.safety;
  config.safety.deadman_button = 0;
  config.passivity = station.passivity;
  config.X_ET = pack(station.X_ET);
  config.X_DF = pack(Pose(station.X_WD.inverse() * station.floor->X_WF));
  config.floor = task_search::renderingOn(task, station);
  config.augmentations = station::onDevice(task.augmentations, station, config.floor.unit);
  return config;
}

/// A place and a way through it, U and U/s in F.
struct FloorQuery {
  double x = 0, y = 0, z = 0, vx = 0, vy = 0;
  int direction = 0, scale = 0;
};

/// Anywhere on the floor, or on the textured discs.
std::vector<FloorQuery> drawLooks(const haptics::SearchSurface& surface, bool on_texture,
                                  int count) {
  RandomStream random(1, on_texture ? "bench.floor.texture" : "bench.floor");
  const haptics::SearchSpec& spec = surface.spec();
  const double half = 0.5 * spec.side;
  std::vector<FloorQuery> looks;
  while (static_cast<int>(looks.size()) < count) {
    FloorQuery look{random.uniform(-half, half), random.uniform(-half, half)};
    if (on_texture && !surface.place(look.x, look.y).texture) continue;
    look.z = surface.smoothHeight(look.x, look.y) - random.uniform(0, kDeepestLook);
    const double speed = 100 * std::exp2(random.uniform(0, 5)), way = random.uniform(0, kWholeTurn);
    look.vx = speed * std::cos(way);
    look.vy = speed * std::sin(way);
    look.direction = static_cast<int>(random.uniform(0, haptics::GaborTable::kDirections));
    look.scale = static_cast<int>(random.uniform(0, haptics::GaborTable::kScales));
    looks.push_back(look);
  }
  return looks;
}

/// What is found is added up, so that no look can be left out.
template <class Ask>
double blockMedian(const std::vector<FloorQuery>& looks, Ask ask) {
  const runtime::SteadyClock clock;
  volatile double found = 0;
  std::vector<double> each;
  for (std::size_t i = 0; i + kBlockOfLooks <= looks.size(); i += kBlockOfLooks) {
    double sum = 0;
    const std::int64_t start = clock.now();
    for (std::size_t k = i; k < i + kBlockOfLooks; ++k) sum += ask(looks[k]);
    each.push_back(1e-3 * static_cast<double>(clock.now() - start) / kBlockOfLooks);
    found = found + sum;
  }
  return quantile(each, 0.5);
}

haptics::DeviceReading readingAt(const Pose& X_DF, const Vec3& p_F) {
  haptics::DeviceReading reading;
  reading.p_DE = pack(Vec3(X_DF * p_F));
  reading.homed = 1;
  return reading;
}

/// The path's readings, round and round, through the tick.
class FloorPath {
 public:
  FloorPath(const SearchFloor& floor, bool augmented)
      : config_(floor.config),
        floor_(floor.made->floor()),
        state_(std::make_unique<haptics::TickState>()) {
    if (!augmented) config_.augmentations = {};
    commands_.trial = commands_.floor = 1;
    commands_.armed = commands_.degraded = 1;
    commands_.augmented = augmented;
    const Pose X_DF = unpack(config_.X_DF), X_TE = unpack(config_.X_ET).inverse();
    for (int i = 0; i < kPathTicks; ++i)
      readings_.push_back(readingAt(X_DF, pathPoint(floor, 1e-3 * i) + X_TE.translation()));
  }

  void step() {
    haptics::DeviceReading& reading = readings_[at_];
    reading.sequence = ++ticks_;
    reading.t_ns = now_ns_ += config_.period_ns;
    const haptics::FlightRecord record =
        haptics::tick(config_, *state_, reading, nullptr, commands_, now_ns_, {}, &floor_);
    pushed_ += record.augmenting != 0;
    pushing_ |= record.augmenting;
    parts_ |= record.subtasks;
    if (++at_ == readings_.size()) at_ = 0;
  }
  int pushing() const { return std::popcount(pushing_); }
  int parts() const { return std::popcount(parts_); }
  double pushed() const { return static_cast<double>(pushed_) / static_cast<double>(ticks_); }

 private:
  static Vec3 pathPoint(const SearchFloor& floor, double t) {
    const double r = floor.task.spec.circle + kAcross * std::sin(kWholeTurn * kAcrossHz * t),
                 angle = kWholeTurn * kRoundHz * t;
    const Vec3 p(r * std::cos(angle), r * std::sin(angle), 0);
    const haptics::FloorRendering& law = floor.config.floor;
    return Vec3(law.unit * Vec3(p.x(), p.y(), floor.made->surface.smoothHeight(p.x(), p.y())) -
                kPress / law.degraded.stiffness * Vec3::UnitZ());
  }

  haptics::TickConfig config_;
  haptics::Floor floor_;
  haptics::TickCommands commands_;
  std::unique_ptr<haptics::TickState> state_;
  std::vector<haptics::DeviceReading> readings_;
  std::size_t at_ = 0;
  std::uint64_t ticks_ = 0, pushed_ = 0;
  unsigned pushing_ = 0, parts_ = 0;  // a bit each
  std::int64_t now_ns_ = 0;
};

}  // namespace

SearchFloor searchFloor(int map_px) {
  SearchFloor floor;
  floor.task = task_search::readSearch(station::assetFile("tasks/search.json"));
  if (map_px > 0) floor.task.map_px = map_px;
  floor.config = floorConfig(
      floor.task, station::readStation(station::assetFile("stations/search_bench.json")));
  task_search::Episode episode;
  episode.mode = assess::SearchMode::augmented;
  episode.stimulus = {kOrientation, 1};
  const runtime::SteadyClock clock;
  const std::int64_t start = clock.now();
  floor.made = task_search::makeFloor(floor.task, episode);
  floor.made_in_s = 1e-9 * static_cast<double>(clock.now() - start);
  return floor;
}

std::vector<LookUp> timeLookUps(const SearchFloor& floor, int blocks) {
  const haptics::SearchSurface& surface = floor.made->surface;
  const haptics::GaborTable& rises = *floor.made->rises;
  const haptics::ValleyMap& valleys = *floor.made->valleys;
  const double first = floor.task.augmentations.plan.subtasks.each[0].conditions[0].threshold;
  std::vector<LookUp> all;
  for (const bool on_texture : {false, true}) {
    const std::vector<FloorQuery> looks = drawLooks(surface, on_texture, blocks * kBlockOfLooks);
    const auto add = [&](const char* name, auto ask) {
      all.push_back({name, on_texture ? "textures" : "anywhere", blockMedian(looks, ask)});
    };
    add("gabor_lookup_median", [&](const FloorQuery& l) {
      return rises.rises(l.x, l.y, l.direction, l.scale) ? 1.0 : 0.0;
    });
    add("gabor_lookup_by_velocity_median", [&](const FloorQuery& l) {
      return rises.rises(l.x, l.y, haptics::GaborTable::directionOf(l.vx, l.vy),
                         haptics::GaborTable::scaleOf(std::hypot(l.vx, l.vy), first))
                 ? 1.0
                 : 0.0;
    });
    add("valley_lookup_median",
        [&](const FloorQuery& l) { return valleys.nearest(l.x, l.y).distance; });
    add("closest_free_median", [&](const FloorQuery& l) {
      return surface.closestFree({l.x, l.y, l.z}).z();
    });
    add("footprint_lookup_median", [&](const FloorQuery& l) {
      return surface.bumpOnWay(l.x - 1e-3 * l.vx, l.y - 1e-3 * l.vy, l.x, l.y);
    });
  }
  return all;
}

FloorTickTiming timeFloorTick(const SearchFloor& floor, int ticks, int blocks) {
  FloorPath augmented(floor, true), plain(floor, false);
  FloorTickTiming timing;
  timing.press_N = kPress;
  timing.augmented = timeQueries(ticks, [&](int) { augmented.step(); });
  timing.plain = timeQueries(ticks, [&](int) { plain.step(); });
  timing.ratio = compareQueries(
      blocks, kPathTicks, [&](int) { plain.step(); }, [&](int) { augmented.step(); });
  timing.pushed = augmented.pushed();
  timing.pushing = augmented.pushing();
  timing.parts = augmented.parts();
  return timing;
}

}  // namespace palpa::bench

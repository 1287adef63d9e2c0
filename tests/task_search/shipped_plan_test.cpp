#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "haptics/loop/tick.h"
#include "tests/surface/surface_bench.h"
#include "tests/task_search/shipped_search.h"

/// The shipped task's parts and its relief, in the tick on the shipped station: against the
/// thresholds as the task states them, and against plain loops over all bumps.
namespace palpa::task_search {
namespace {

using haptics::Draws;
using haptics::FlightRecord;
using haptics::SearchSurface;

constexpr double kScan_U = 468.75, kIdentify_U = 400;           // U/s
constexpr unsigned kScanOn = 1, kShapeOn = 2, kIdentifyOn = 4;  // bits of FlightRecord::subtasks
constexpr double kPressed_U = -3, kLifted_U = 5;  // under the deepest groove; over the highest bump
constexpr double kTurn = 2 * std::numbers::pi;

const SearchSettings& theTask() {
  static const SearchSettings task = shippedSearch();
  return task;
}

const SearchSurface& theFloor() {
  static const SearchSurface floor =
      surfaceOf(theTask().spec, episodeWith(assess::SearchMode::augmented));
  return floor;
}

/// The shipped search on its station, led by positions in U; `quantum`: of the device's readings,
/// m.
struct SearchLoop {
  haptics::TickConfig config;
  haptics::TickCommands commands;
  haptics::TickState state;
  double quantum = 0;
  std::int64_t now = 0;
  std::uint64_t readings = 0;

  explicit SearchLoop(double quantum_m = 0) : quantum(quantum_m) {
    const station::Station station =
        station::readStation(station::assetFile("stations/search_bench.json"));
    config.contact_mode = haptics::ContactMode::floor;
    config.coupling = station.coupling;
    config.safety = station.safety;
    config.passivity = station.passivity;
    config.X_DF = pack(Pose(station.X_WD.inverse() * station.floor->X_WF));
    config.floor = renderingOn(theTask(), station);
    config.augmentations = station::onDevice(theTask().augmentations, station, config.floor.unit);
    commands.armed = 1;
    commands.augmented = 1;
  }
  FlightRecord step(const Vec3& p_U) {
    Vec3 p_D = unpack(config.X_DF) * (config.floor.unit * p_U);
    if (quantum > 0) p_D = quantum * (p_D / quantum).array().round().matrix();
    haptics::DeviceReading reading;
    reading.t_ns = now += 1'000'000;
    reading.sequence = ++readings;
    reading.homed = 1;
    reading.p_DE = pack(p_D);
    const haptics::Floor floor{&theFloor(), nullptr, nullptr};
    return haptics::tick(config, state, reading, nullptr, commands, now, {}, &floor);
  }
};

Vec3 middleOf(int element) {
  return {theFloor().middle(element)[0], theFloor().middle(element)[1], 0};
}
Vec3 wayAt(double angle) { return {std::cos(angle), std::sin(angle), 0}; }
Vec3 pressedAt(const Vec3& p_U) { return {p_U.x(), p_U.y(), kPressed_U}; }

/// The speed as the task measures it: a low-pass of 5 ms on what was read.
struct MeasuredSpeed {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero();  // U, U/s
  bool started = false;
  double next(const Vec3& p_U) {
    constexpr double kTau = 0.005, kTick = 0.001;
    if (started) v += ((p_U - p) / kTick - v) * (kTick / (kTau + kTick));
    p = p_U;
    started = true;
    return v.head<2>().norm();
  }
};

/// As stated: scan from 468.75 U/s on, to 5 % less; identify in contact with a texture from 400 U/s
/// on, to 5 % less; both kept for 100 ms. Shape in contact, kept for 100 ms, and where it has been
/// slower than 468.75 U/s for 100 ms, to 5 % more.
class Stated {
 public:
  unsigned next(int i, double speed, bool contact, bool texture) {
    const auto kept = [&](unsigned bit, bool holds, int* held_at) {
      if (holds) *held_at = i;
      return holds || (on_ & bit && i - *held_at < 100);
    };
    const bool shape_was = on_ & kShapeOn, slow = speed < (shape_was ? 1.05 : 1) * kScan_U;
    if (!slow) fast_at_ = i;
    if (contact && slow) shape_at_ = i;
    const bool scan = kept(kScanOn, speed >= (on_ & kScanOn ? 0.95 : 1) * kScan_U, &scan_at_);
    const bool identify = kept(
        kIdentifyOn, contact && texture && speed >= (on_ & kIdentifyOn ? 0.95 : 1) * kIdentify_U,
        &identify_at_);
    const bool shape =
        slow && (shape_was ? contact || i - shape_at_ < 100 : contact && i - fast_at_ >= 100);
    on_ = (scan ? kScanOn : 0) | (shape ? kShapeOn : 0) | (identify ? kIdentifyOn : 0);
    return on_;
  }

 private:
  unsigned on_ = 0;
  int scan_at_ = 0, identify_at_ = 0, shape_at_ = 0, fast_at_ = -1;
};

/// Wanders over the floor at 100 to 800 U/s, now pressed, now lifted.
struct Wanderer {
  Draws draw{31};
  Vec3 p = middleOf(0) + kPressed_U * Vec3::UnitZ();
  double angle = 0, turning = 0, speed = 0, wanted = 0;
  Vec3 next(int i) {
    if (i % 150 == 0) {
      wanted = draw.from(100, 800);
      turning = draw.from(-12, 12);
      p.z() = draw() < 0.75 ? kPressed_U : kLifted_U;
    }
    speed += (wanted - speed) * 0.02;
    angle += turning * 1e-3;
    p += speed * 1e-3 * wayAt(angle);
    if (p.head<2>().norm() > 105) angle = std::atan2(-p.y(), -p.x());
    return p;
  }
};

bool onTexture(const Vec3& p) {
  for (int e = 0; e < 3; ++e) {
    const double r = (p - middleOf(e)).head<2>().norm();
    if (r >= theTask().spec.pit && r <= theTask().spec.disc) return true;
  }
  return false;
}

TEST(ShippedPlan, PartsAreOnExactlyAsStated) {
  SearchLoop loop;
  MeasuredSpeed measured;
  Wanderer wanderer;
  Stated stated;
  unsigned was = 0;
  std::array<int, 3> begun{};
  for (int i = 0; i < 120'000; ++i) {
    const Vec3 p = wanderer.next(i);
    const unsigned on = stated.next(i, measured.next(p), p.z() < 0, onTexture(p));
    const FlightRecord at = loop.step(p);
    ASSERT_EQ(at.subtasks, on) << i << ": " << measured.v.norm();
    for (unsigned part = 0; part < 3; ++part) begun[part] += (on & ~was) >> part & 1u;
    was = on;
  }
  for (const int count : begun) EXPECT_GT(count, 40);
}

/// A line across an element at a steady speed; nothing is forgotten of it.
struct StrokeLine {
  Vec3 from = Vec3::Zero(), way = Vec3::Zero();
  int ticks = 0;
};
StrokeLine lineAcross(Draws& draw, int element, double speed) {
  constexpr double kRunUp = 45;  // U: over the groove, so that the speed is measured in full
  StrokeLine line;
  const double angle = draw.from(0, kTurn), offset = draw.from(-24, 24),
               begin = draw.from(0, 1e-3 * speed);
  line.way = wayAt(angle);
  line.from = middleOf(element) + offset * wayAt(angle + kTurn / 4) - (kRunUp + begin) * line.way;
  line.ticks = static_cast<int>(2 * kRunUp / (1e-3 * speed)) + 30;
  return line;
}

/// By all that is stated: 0.8 N on the highest bumps, half as much on those half as high, at once
/// with its part.
double statedRelief(bool identify, double height_U) { return identify ? 0.8 * height_U / 2 : 0; }

/// Where footprints are under the probe or were entered since the last tick, and nowhere else, at
/// 400 to 20,000 U/s.
TEST(ShippedPlan, TheReliefPushesExactlyOverFootprints) {
  Draws draw(32);
  for (const double speed : {425.0, 1000.0, 3000.0, 8000.0, 20'000.0}) {
    int high = 0, low = 0, bare = 0;
    for (int n = 0; n < 60; ++n) {
      const StrokeLine line = lineAcross(draw, n % 3, speed);
      SearchLoop loop;
      Vec3 before = pressedAt(line.from);
      for (int i = 0; i < line.ticks; ++i) {
        const Vec3 p = pressedAt(line.from + i * 1e-3 * speed * line.way);
        const FlightRecord at = loop.step(p);
        const haptics::WayOverBumps way =
            haptics::plainWay(theFloor(), before.x(), before.y(), p.x(), p.y());
        before = p;
        const bool identify = at.subtasks & kIdentifyOn;
        const double push = statedRelief(identify, way.heights.empty() ? 0 : way.heights[0]);
        if (way.unsure) continue;
        const Vec3 f = unpack(at.f_augmentation_D);
        ASSERT_NEAR(f.z(), push, 1e-9) << speed << ' ' << n << ' ' << i;
        ASSERT_EQ(f.head<2>().norm(), 0);
        if (push > 1e-9) {
          ASSERT_EQ(at.augmenting, 4);
          ++(way.heights[0] > 1.5 ? high : low);
        } else if (identify) {
          ++bare;
        }
      }
    }
    EXPECT_GT(high, 5) << speed;
    EXPECT_GT(low, 5) << speed;
    EXPECT_GT(bare, 5) << speed;
  }
}

TEST(ShippedPlan, WithoutIdentifyingThereIsNoRelief) {
  Draws draw(33);
  for (int n = 0; n < 12; ++n) {
    const bool slow = n % 2;  // else fast, but lifted
    const double speed = slow ? 370 : 800;
    const StrokeLine line = lineAcross(draw, n % 3, speed);
    SearchLoop loop;
    for (int i = 0; i < line.ticks; ++i) {
      Vec3 p = pressedAt(line.from + i * 1e-3 * speed * line.way);
      if (!slow) p.z() = kLifted_U;
      const FlightRecord at = loop.step(p);
      ASSERT_FALSE(at.subtasks & kIdentifyOn);
      ASSERT_EQ(at.f_augmentation_D, (Packed3{0, 0, 0})) << n << ' ' << i;
    }
  }
}

/// The relief needs the contact.
TEST(ShippedPlan, LiftedTheReliefEndsAtOnce) {
  Draws draw(36);
  int pushed = 0;
  for (int n = 0; n < 12; ++n) {
    const StrokeLine line = lineAcross(draw, 0, 1500);
    SearchLoop loop;
    for (int i = 0; i < line.ticks; ++i) {
      const bool lifted = i % 8 >= 6;
      Vec3 p = pressedAt(line.from + i * 1.5 * line.way);
      if (lifted) p.z() = kLifted_U;
      const FlightRecord at = loop.step(p);
      if (lifted) {
        ASSERT_EQ(at.f_augmentation_D, (Packed3{0, 0, 0})) << n << ' ' << i;
      } else {
        pushed += unpack(at.f_augmentation_D).norm() > 0;
      }
    }
  }
  EXPECT_GT(pushed, 20);
}

TEST(ShippedPlan, NotAugmentedItAddsExactlyNothing) {
  Draws draw(34);
  for (int n = 0; n < 6; ++n) {
    const StrokeLine line = lineAcross(draw, n % 3, 700);
    SearchLoop loop;
    loop.commands.augmented = 0;
    unsigned parts = 0;
    for (int i = 0; i < line.ticks; ++i) {
      const FlightRecord at = loop.step(pressedAt(line.from + i * 0.7 * line.way));
      ASSERT_EQ(at.f_augmentation_D, (Packed3{0, 0, 0}));
      ASSERT_EQ(at.augmenting | at.began, 0);
      parts |= at.subtasks;
    }
    EXPECT_TRUE(parts & kScanOn);
  }
}

/// Ticks from the first reading at which the true speed is there (or no longer) until the part is
/// on; 200: not at all.
int ticksUntil(unsigned part, SearchLoop& loop, const Vec3& from, const Vec3& v_U, bool begins) {
  constexpr int kLong = 200;
  const Vec3 still = Vec3::Zero();
  Vec3 p = from;
  for (int i = 0; i < 40; ++i) {
    loop.step(p);
    p += 1e-3 * (begins ? still : v_U);
  }
  for (int i = 0; i < kLong; ++i) {
    if (loop.step(p).subtasks & part) return i;
    p += 1e-3 * (begins ? v_U : still);
  }
  return kLong;
}

/// A steady speed that begins, 1.3 times the threshold, read in steps: the low-pass has 1 / 1.3 of
/// it after 9 ms.
TEST(ShippedPlan, APartIsOnWithinTenMilliseconds) {
  constexpr double kMargin = 1.3;
  Draws draw(35);
  for (const double quantum : {2e-6, 5e-6}) {
    std::array<int, 4> latest{};
    for (int n = 0; n < 100; ++n) {
      const Vec3 way = wayAt(draw.from(0, kTurn)), start = pressedAt(5 * Vec3(draw(), draw(), 0));
      const auto until = [&](unsigned part, const Vec3& from, double speed, bool begins) {
        SearchLoop loop(quantum);
        return ticksUntil(part, loop, from, speed * way, begins);
      };
      const Vec3 texture = pressedAt(middleOf(n % 3) + 12 * wayAt(draw.from(0, kTurn)));
      latest[0] = std::max(latest[0], until(kScanOn, start, kMargin * kScan_U, true));
      latest[1] = std::max(latest[1], until(kIdentifyOn, texture, kMargin * kIdentify_U, true));
      latest[2] = std::max(latest[2], until(kShapeOn, start, kMargin * kScan_U, false));  // it ends
      SearchLoop landing(quantum);
      for (int i = 0; i < 120; ++i) landing.step({start.x(), start.y(), kLifted_U});
      latest[3] = std::max(latest[3], ticksUntil(kShapeOn, landing, start, Vec3::Zero(), true));
    }
    EXPECT_GT(latest[2], 100) << "a hand that is slow for a moment only turns round";
    latest[2] -= 100;
    for (const int ms : latest) EXPECT_LE(ms, 10) << quantum;
    EXPECT_GE(latest[0], 8) << "the low-pass is there";
  }
}

/// How often a part came or went in 10 s round a circle.
int switchesIn(unsigned part, double quantum, const Vec3& middle, double radius, double speed) {
  SearchLoop loop(quantum);
  int switches = 0;
  bool was = false;
  for (int i = 0; i < 10'000; ++i) {
    const bool on =
        loop.step(pressedAt(middle + radius * wayAt(0.3 + i * 1e-3 * speed / radius))).subtasks &
        part;
    switches += on != was;
    was = on;
  }
  return switches;
}

/// It comes on at the beginning or not at all: fewer than 2 switches a second would be allowed.
TEST(ShippedPlan, ASteadySpeedDoesNotChatter) {
  for (const double quantum : {2e-6, 5e-6}) {
    EXPECT_EQ(switchesIn(kScanOn, quantum, Vec3::Zero(), 60, 1.15 * kScan_U), 1) << quantum;
    EXPECT_EQ(switchesIn(kScanOn, quantum, Vec3::Zero(), 60, 0.85 * kScan_U), 0) << quantum;
    EXPECT_EQ(switchesIn(kShapeOn, quantum, Vec3::Zero(), 60, 1.15 * kScan_U), 0) << quantum;
    EXPECT_EQ(switchesIn(kShapeOn, quantum, Vec3::Zero(), 60, 0.85 * kScan_U), 1) << quantum;
    for (int e = 0; e < 3; ++e) {
      EXPECT_EQ(switchesIn(kIdentifyOn, quantum, middleOf(e), 15, 1.15 * kIdentify_U), 1)
          << quantum;
      EXPECT_EQ(switchesIn(kIdentifyOn, quantum, middleOf(e), 15, 0.85 * kIdentify_U), 0)
          << quantum;
    }
  }
}

}  // namespace
}  // namespace palpa::task_search

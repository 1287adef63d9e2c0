#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <ostream>

#include "apps/station/station_file.h"
#include "apps/twin/device_twin.h"
#include "haptics/loop/tick.h"
#include "tests/task_search/shipped_search.h"

/// The shipped search with every cue on, on devices that are weak and coarse: forces scaled and
/// within the limits, a handle that stays where it is led and comes to rest.
namespace palpa::task_search {
namespace {

struct WeakDevice {
  const char* name;
  double max_force_N, stable;  ///< N, N/m
  double step, unit;           ///< m; of a reading, and of a U: coarse devices need a large one
  double mass, coulomb;        ///< kg, N
};
std::ostream& operator<<(std::ostream& out, const WeakDevice& device) { return out << device.name; }

const MadeFloor& cuedFloor() {
  static const SearchSettings task = shippedSearch();
  static const std::unique_ptr<MadeFloor> floor =
      makeFloor(task, episodeWith(assess::SearchMode::augmented));
  return *floor;
}

/// A floor in D's x and y, a device that moves, a hand that leads it.
class WeakLoop {
 public:
  explicit WeakLoop(const WeakDevice& device)
      : device_(device), twin_(truthOf(device), Pose(Eigen::Translation3d(0, 0, 0))) {
    const SearchSettings task = shippedSearch();
    config_.contact_mode = haptics::ContactMode::floor;
    config_.coupling.stiffness = device.stable;
    config_.safety.max_force_N = device.max_force_N;
    config_.safety.max_energy_J = 0.25;
    config_.passivity.coulomb = device.coulomb;
    config_.floor = task.rendering;
    config_.floor.unit = device.unit;
    const double held = std::min(1.0, device.stable / task.rendering.real.stiffness);
    config_.floor.real.stiffness *= held;
    config_.floor.real.damping *= held;
    config_.floor.degraded = {task.degraded_share * config_.floor.real.stiffness,
                              held * task.rendering.degraded.damping};
    station::Station station;
    station.safety = config_.safety;
    station.device.capabilities.stable_stiffness = device.stable;
    config_.augmentations = station::onDevice(task.augmentations, station, device.unit);
    commands_.armed = commands_.augmented = commands_.degraded = 1;
  }

  /// A millisecond, the hand where it wants the handle, in U.
  haptics::FlightRecord lead(const Vec3& goal_U) {
    haptics::DeviceReading reading;
    reading.t_ns = now_ += 1'000'000;
    reading.sequence = ++readings_;
    reading.homed = 1;
    reading.p_DE = twin_.encoderPose().p;
    const haptics::Floor floor = cuedFloor().floor();
    const haptics::FlightRecord record =
        haptics::tick(config_, state_, reading, nullptr, commands_, now_, {}, &floor);
    twin_.advance(1e-3, Pose(Eigen::Translation3d(device_.unit * goal_U)), {300, 4, 0.1},
                  unpack(record.f_command_D));
    return record;
  }
  Vec3 at_U() const { return twin_.truePose().translation() / device_.unit; }
  double speed() const { return twin_.trueVelocity().norm(); }  ///< m/s
  /// How far under the floor a hand aims that presses with f
  double press_U(double f) const { return -f / 300 / device_.unit; }

 private:
  static twin::DeviceTruth truthOf(const WeakDevice& device) {
    twin::DeviceTruth truth;
    truth.apparent_mass = device.mass;
    truth.coulomb = device.coulomb;
    truth.encoder_step = device.step;
    truth.max_force_N = device.max_force_N;
    return truth;
  }
  const WeakDevice device_;
  twin::DeviceTwin twin_;
  haptics::TickConfig config_;
  haptics::TickCommands commands_;
  haptics::TickState state_;
  std::int64_t now_ = 0;
  std::uint64_t readings_ = 0;
};

class LimitedDevice : public testing::TestWithParam<WeakDevice> {};

/// Round the circle on which the elements lie, faster and slower than a scan: 2.2 to 0.2 turns a
/// second.
TEST_P(LimitedDevice, NeverGivesMoreThanItCanAndNeverStops) {
  WeakLoop loop(GetParam());
  double pushed = 0, added = 0, farthest = 0, angle = 0;
  for (int i = 0; i < 12'000; ++i) {
    const double speed = 500 + 400 * std::sin(0.001 * i);  // U/s
    angle += 1e-3 * speed / (200.0 / 3);
    const Vec3 goal(200.0 / 3 * std::cos(angle), 200.0 / 3 * std::sin(angle),
                    loop.press_U(std::min(1.0, 0.001 * i)));
    const haptics::FlightRecord record = loop.lead(goal);
    ASSERT_LE(unpack(record.f_command_D).norm(), GetParam().max_force_N * (1 + 1e-12));
    ASSERT_LE(unpack(record.f_augmentation_D).norm(), 0.5 * GetParam().max_force_N * (1 + 1e-12));
    ASSERT_TRUE(record.safety == haptics::SafetyCause::none ||
                record.safety == haptics::SafetyCause::clamp ||
                record.safety == haptics::SafetyCause::slew)
        << name(record.safety);
    pushed = std::max(pushed, unpack(record.f_command_D).norm());
    added = std::max(added, unpack(record.f_augmentation_D).norm());
    if (i > 1000)
      farthest = std::max(farthest, GetParam().unit * (loop.at_U() - goal).head<2>().norm());
  }
  EXPECT_GT(pushed, 0.5);
  EXPECT_GT(added, 0.3) << "cues that are not felt prove nothing";
  // What the lag of a hand of 300 N/m on this mass explains, and all that cues can pull at its
  // spring besides.
  EXPECT_LT(farthest, 0.5 * GetParam().max_force_N / 300 + 0.02);
}

/// Beside a groove's bottom, where the pull is steepest, and in a pit: the hand holds still, and so
/// does the handle.
TEST_P(LimitedDevice, ComesToRestInAValley) {
  const auto [mx, my] = cuedFloor().surface.middle(0);
  for (const double beside : {0.0, 28.0, 29.0, 30.0, 31.5}) {
    WeakLoop loop(GetParam());
    const Vec3 above(mx + beside, my, loop.press_U(0));
    double fastest = 0, added = 0;
    for (int i = 0; i < 6000; ++i) {
      Vec3 goal = above * std::min(1.0, 0.001 * i);
      goal.z() = loop.press_U(std::clamp(0.001 * (i - 1000), 0.0, 1.0));
      const haptics::FlightRecord record = loop.lead(goal);
      added = std::max(added, unpack(record.f_augmentation_D).norm());
      if (i >= 5000) fastest = std::max(fastest, loop.speed());
    }
    EXPECT_LT(fastest, 0.002) << "still, to a step of the reading in some milliseconds; " << beside;
    const bool at_bottom = beside == 0.0 || beside == 30.0;  // where nothing pulls any more
    EXPECT_EQ(added > 0.05, !at_bottom) << beside << ": " << added;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, LimitedDevice,
                         testing::Values(WeakDevice{"3.3 N", 3.3, 1000, 55e-6, 250e-6, 0.045, 0.06},
                                         WeakDevice{"8 N", 7.9, 1000, 23e-6, 250e-6, 0.045, 0.06}),
                         [](const auto& one) {
                           return one.param.max_force_N < 5 ? std::string("OfThreeNewton")
                                                            : std::string("OfEightNewton");
                         });

}  // namespace
}  // namespace palpa::task_search

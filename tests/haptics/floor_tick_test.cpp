#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "adds_up.h"
#include "haptics/loop/tick.h"
#include "tests/support/allocation_count.h"
#include "tests/surface/surface_bench.h"

/// A floor that is searched, in the loop: the handle's weight, how it is held, gains, what is
/// added.
namespace palpa::haptics {
namespace {

constexpr double kWeight_N = 4.9;
const Pose kTurnedFloor =
    makePose(Eigen::AngleAxisd(0.8, Vec3(1, -2, 0.5).normalized()).toRotationMatrix(),
             Vec3(0.02, -0.1, 0.06));

/// Led by positions in U over the floor, at 1 kHz.
struct FloorLoop {
  SearchSurface surface = searchFloor(22);
  const GaborTable* rises = nullptr;
  const ValleyMap* valleys = nullptr;
  bool there = true;
  TickConfig config;
  TickCommands commands;
  TickState state;
  std::int64_t now = 0;
  std::uint64_t readings = 0;

  explicit FloorLoop(const Pose& X_DF = kTurnedFloor) {
    config.contact_mode = ContactMode::floor;
    config.X_DF = pack(X_DF);
    config.coupling = {5250, 0.001};
    config.floor.weight_N = kWeight_N;
    config.safety.max_force_N = 100;
    config.safety.max_slew_N_per_s = 1e6;
    commands.armed = 1;
  }
  double unit() const { return config.floor.unit; }
  Vec3 inF(const Packed3& f_D) const {
    return unpack(config.X_DF).linear().transpose() * unpack(f_D);
  }
  FlightRecord step(const Vec3& p_U) {
    DeviceReading reading;
    reading.t_ns = now += 1'000'000;
    reading.sequence = ++readings;
    reading.homed = 1;
    reading.p_DE = pack(Vec3(unpack(config.X_DF) * (unit() * p_U)));
    const Floor floor{&surface, rises, valleys};
    TickForces forces;
    const FlightRecord record =
        tick(config, state, reading, nullptr, commands, now, {}, there ? &floor : nullptr, &forces);
    expectAddsUp(record, forces);
    return record;
  }
  /// There until it is at rest: the velocity's time constant is 1 ms.
  FlightRecord rest(const Vec3& p_U) {
    FlightRecord last;
    for (int i = 0; i < 60; ++i) last = step(p_U);
    return last;
  }
};

void expectForce(const FloorLoop& loop, const Packed3& f_D, const Vec3& f_F) {
  EXPECT_LT((loop.inF(f_D) - f_F).norm(), 1e-9) << loop.inF(f_D).transpose();
}

TEST(FloorTick, HeldTheHandleIsOnASpringToItsStart) {
  FloorLoop loop;
  loop.commands.held = 1;
  const Vec3 start(0, 0, 20), carried(0, 0, kWeight_N);
  for (const Vec3& away : {Vec3(0, 0, 0), Vec3(10, -5, 3), Vec3(-12, 16, -20)}) {
    const FlightRecord at = loop.rest(start + away);
    expectForce(loop, at.f_command_D, carried - 500 * loop.unit() * away);
    EXPECT_EQ(at.safety, SafetyCause::none);
  }
}

TEST(FloorTick, ItIsHeldByNoMoreThanItsForce) {
  FloorLoop loop;
  loop.commands.held = 1;
  for (const Vec3& away : {Vec3(60, 0, 0), Vec3(-70, 30, 90), Vec3(0, 0, -80)})
    expectForce(loop, loop.rest(Vec3(0, 0, 20) + away).f_command_D,
                Vec3(0, 0, kWeight_N) - away.normalized());
}

TEST(FloorTick, HeldThereIsNoFloor) {
  FloorLoop loop;
  loop.commands.held = 1;
  const Vec3 under(3, -4, -3);
  const FlightRecord held = loop.rest(under);
  EXPECT_EQ(held.f_contact_D, (Packed3{0, 0, 0}));
  EXPECT_EQ(held.indentation, 0);
  EXPECT_EQ(held.place, 0);
  loop.commands.held = 0;
  const FlightRecord free = loop.rest(under);
  expectForce(loop, free.f_contact_D, Vec3(0, 0, 5250 * 3 * loop.unit()));
  expectForce(loop, free.f_command_D, Vec3(0, 0, kWeight_N + 5250 * 3 * loop.unit()));
  EXPECT_EQ(free.place, kPlaceTouching);
}

TEST(FloorTick, TheWeightIsCarriedAndIsNoContact) {
  FloorLoop loop;
  const FlightRecord above = loop.rest({0, 0, 10});
  expectForce(loop, above.f_command_D, Vec3(0, 0, kWeight_N));
  EXPECT_EQ(above.f_contact_D, (Packed3{0, 0, 0}));
  EXPECT_EQ(above.f_augmentation_D, (Packed3{0, 0, 0}));
  loop.commands.force_feedback = 0;
  for (const double z : {10.0, -3.0})
    EXPECT_EQ(loop.rest({0, 0, z}).f_command_D, (Packed3{0, 0, 0})) << z;
  expectForce(loop, loop.rest({0, 0, -3}).f_contact_D,
              Vec3(0, 0, 5250 * 3 * loop.unit()));  // computed all the same
  loop.commands.held = 1;
  EXPECT_EQ(loop.rest({30, 0, 0}).f_command_D, (Packed3{0, 0, 0}));
}

/// Lifted and lowered in the free: the weight gives and takes work, none of which the observer of
/// the contact sees.
TEST(FloorTick, ThePassivityObserverLeavesTheWeightAlone) {
  FloorLoop loop;
  loop.config.passivity.max_damping = 50;
  loop.config.passivity.unfelt_J = 1e-6;
  for (int i = 0; i < 2000; ++i) {
    const FlightRecord at = loop.step({0, 0, 100 + 90 * std::sin(0.02 * i)});
    ASSERT_EQ(at.damped, 0) << i;
    ASSERT_NEAR(loop.state.passivity.energy_J, 0, 1e-15) << i;
    if (i > 0) expectForce(loop, at.f_command_D, Vec3(0, 0, kWeight_N));
  }
}

TEST(FloorTick, DegradedHasTheLesserGains) {
  FloorLoop loop;
  loop.config.floor.real = {5250, 0};
  loop.config.floor.degraded = {1050, 4};
  loop.rest({0, 0, -3});
  loop.commands.degraded = 1;
  expectForce(loop, loop.rest({0, 0, -3}).f_command_D,
              Vec3(0, 0, kWeight_N + 1050 * 3 * loop.unit()));
  FlightRecord down;
  for (int i = 0; i < 100; ++i)
    down = loop.step({0, 0, -3 - 0.05 * i});  // steadily: the velocity is as it is
  const double v = -0.05 * loop.unit() / 1e-3;
  expectForce(loop, down.f_contact_D, Vec3(0, 0, 1050 * (3 + 0.05 * 99) * loop.unit() - 4 * v));
  loop.commands.degraded = 0;
  expectForce(loop, loop.rest({0, 0, -3}).f_contact_D, Vec3(0, 0, 5250 * 3 * loop.unit()));
}

TEST(FloorTick, TheCouplingBoundsItsStiffness) {
  FloorLoop loop;
  loop.config.coupling.stiffness = 800;
  expectForce(loop, loop.rest({0, 0, -3}).f_contact_D, Vec3(0, 0, 800 * 3 * loop.unit()));
}

TEST(FloorTick, WithoutAFloorThereIsOnlyTheWeight) {
  FloorLoop loop;
  loop.there = false;
  const FlightRecord at = loop.rest({0, 0, -50});
  EXPECT_EQ(at.f_contact_D, (Packed3{0, 0, 0}));
  expectForce(loop, at.f_command_D, Vec3(0, 0, kWeight_N));
}

/// Neither the weight nor the floor comes through a stop, between trials, or on a reading that
/// cannot be.
TEST(FloorTick, TheLimiterHasTheLastWord) {
  FloorLoop loop;
  loop.commands.armed = 0;
  EXPECT_EQ(loop.rest({0, 0, -3}).f_command_D, (Packed3{0, 0, 0}));
  loop.commands.armed = 1;
  EXPECT_GT(unpack(loop.rest({0, 0, -3}).f_command_D).norm(), kWeight_N);
  EXPECT_EQ(loop.step({0, 0, 400}).f_command_D, (Packed3{0, 0, 0})) << "24 m/s";
  loop.rest({0, 0, -3});
  loop.commands.emergency_stop = 1;
  EXPECT_EQ(loop.step({0, 0, -3}).f_command_D, (Packed3{0, 0, 0}));
  FloorLoop weak;
  weak.config.safety.max_force_N = 5;
  EXPECT_NEAR(unpack(weak.rest({0, 0, -60}).f_command_D).norm(), 5, 1e-9);
}

/// One of every kind, always on, and what they need to know of the floor: it rises everywhere, and
/// every groove is a valley.
struct EverythingOn {
  GaborTable rises{64, 240};
  std::unique_ptr<ValleyMap> valleys;
  AugmentationPlan plan;

  explicit EverythingOn(const SearchSurface& surface) {
    for (int j = 0; j < 64; ++j)
      for (int i = 0; i < 64; ++i)
        for (int d = 0; d < GaborTable::kDirections; ++d)
          for (int s = 0; s < GaborTable::kScales; ++s) rises.set(i, j, d, s, (i + j) % 2);
    std::vector<ValleyPoint> points;
    for (int e = 0; e < 3; ++e)
      for (int k = 0; k < 400; ++k) {
        const double a = k * 6.283185307179586 / 400;
        points.push_back({surface.middle(e)[0] + 30 * std::cos(a),
                          surface.middle(e)[1] + 30 * std::sin(a), -std::sin(a), std::cos(a), 2});
      }
    valleys = std::make_unique<ValleyMap>(std::move(points), 240, 6);
    for (const AugmentationKind kind :
         {AugmentationKind::pulse, AugmentationKind::vibration, AugmentationKind::attraction,
          AugmentationKind::exaggeration, AugmentationKind::fixture, AugmentationKind::relief}) {
      Augmentation& a = plan.each[plan.count++];
      a.kind = kind;
      a.amplitude = kind == AugmentationKind::fixture ? 100 : 0.5;
      a.reach = kind == AugmentationKind::fixture ? 0 : 5 * 60e-6;  // its line is far off
      a.tau_s = 0.05;
      a.wavelength = 1e-3;
      a.trigger = kind == AugmentationKind::pulse    ? Augmentation::Trigger::rise
                  : kind == AugmentationKind::relief ? Augmentation::Trigger::bump
                                                     : Augmentation::Trigger::none;
    }
    plan.each[plan.count] = plan.each[0];
    plan.each[plan.count].way = Augmentation::Way::against_motion;
    plan.each[plan.count++].subtask = 0;
    plan.subtasks.count = 1;
    plan.subtasks.each[0].count = 1;
    plan.subtasks.each[0].conditions[0] = {
        Signal::floor_speed, Condition::Compare::at_least, 0, {}, 100, 0.05};
    plan.largest = 5;
    plan.steepest = 5000;
  }
  void putInto(FloorLoop& loop) const {
    loop.rises = &rises;
    loop.valleys = valleys.get();
    loop.config.augmentations = plan;
    loop.commands.augmented = 1;
    loop.commands.line_p_D = loop.config.X_DF.p;
    loop.commands.line_a_D = {0, 0, 1};
  }
};

/// Over an element and its groove, up and down on the floor, at 600 U/s.
Vec3 overTheElement(const SearchSurface& surface, int i) {
  return {surface.middle(1)[0] - 45 + 0.6 * (i % 150), surface.middle(1)[1] + 8,
          -1 + 2 * std::sin(0.05 * i)};
}

TEST(FloorTick, WithEverythingOnItAllocatesNothing) {
  FloorLoop loop;
  const EverythingOn everything(loop.surface);
  everything.putInto(loop);
  loop.step(overTheElement(loop.surface, 0));
  unsigned active = 0, began = 0;
  const NoAllocation none;
  for (int i = 1; i < 150; ++i) {
    const FlightRecord at = loop.step(overTheElement(loop.surface, i));
    active |= at.augmenting;
    began |= at.began;
  }
  EXPECT_EQ(none.allocations(), 0);
  EXPECT_EQ(active, 0b1111111u);
  EXPECT_EQ(began, 0b1100001u);  // both pulses and the relief
}

TEST(FloorTick, WhatIsAddedIsToldApartAndFelt) {
  FloorLoop with, without;
  const EverythingOn everything(with.surface);
  everything.putInto(with);
  double largest = 0;
  for (int i = 0; i < 150; ++i) {
    const FlightRecord a = with.step(overTheElement(with.surface, i)),
                       b = without.step(overTheElement(without.surface, i));
    ASSERT_EQ(a.f_contact_D, b.f_contact_D);
    expectForce(with, a.f_command_D, with.inF(b.f_command_D) + with.inF(a.f_augmentation_D));
    largest = std::max(largest, unpack(a.f_augmentation_D).norm());
  }
  EXPECT_GT(largest, 0.4);
  EXPECT_LE(largest, 5 + 1e-12);
}

/// To the bit, and the parts are told all the same.
TEST(FloorTick, NotAugmentedNothingIsAdded) {
  FloorLoop off, none;
  const EverythingOn everything(off.surface);
  everything.putInto(off);
  off.commands.augmented = 0;
  unsigned parts = 0;
  for (int i = 0; i < 150; ++i) {
    const FlightRecord a = off.step(overTheElement(off.surface, i)),
                       b = none.step(overTheElement(none.surface, i));
    ASSERT_EQ(a.f_augmentation_D, (Packed3{0, 0, 0})) << i;
    ASSERT_EQ(a.augmenting | a.began, 0) << i;
    ASSERT_EQ(a.f_command_D, b.f_command_D) << i;
    parts |= a.subtasks;
  }
  EXPECT_EQ(parts, 1u);
}

TEST(FloorTick, ANewTrialBeginsAnew) {
  FloorLoop loop;
  const EverythingOn everything(loop.surface);
  everything.putInto(loop);
  for (int i = 0; i < 60; ++i) loop.step(overTheElement(loop.surface, i));
  ASSERT_EQ(loop.state.augmentation.subtasks.on, 1u);
  loop.commands.trial = 2;
  const FlightRecord first = loop.step(overTheElement(loop.surface, 60));
  EXPECT_EQ(first.subtasks, 0);
  EXPECT_EQ(unpack(loop.state.tip.v_D), Vec3(Vec3::Zero()));
  EXPECT_NEAR(loop.state.augmentation.weight[1], 0.05, 1e-12) << "blends in again";
}

TEST(FloorTick, GoesOnFromAnyKeyframe) {
  auto loop = std::make_unique<FloorLoop>();
  const EverythingOn everything(loop->surface);
  everything.putInto(*loop);
  for (int i = 0; i < 70; ++i) loop->step(overTheElement(loop->surface, i));
  auto copy = std::make_unique<FloorLoop>(*loop);
  for (int i = 70; i < 140; ++i) {
    const FlightRecord a = loop->step(overTheElement(loop->surface, i)),
                       b = copy->step(overTheElement(copy->surface, i));
    ASSERT_EQ(a.f_command_D, b.f_command_D);
    ASSERT_EQ(a.f_augmentation_D, b.f_augmentation_D);
    ASSERT_EQ(a.began, b.began);
  }
}

}  // namespace
}  // namespace palpa::haptics

#include "haptics/augmentation/augmentation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace palpa::haptics {
namespace {

AugmentationPlan planOf(const Augmentation& a) {
  AugmentationPlan plan;
  plan.each[0] = a;
  plan.count = 1;
  plan.largest = 100;
  plan.steepest = 1e9;
  return plan;
}

Augmentation pulseOn(Augmentation::Trigger trigger) {
  Augmentation a;
  a.kind = AugmentationKind::pulse;
  a.trigger = trigger;
  a.amplitude = 0.8;
  a.width_s = 0.010;
  return a;
}

AugmentationInput upward() {
  AugmentationInput in;
  in.up = Vec3::UnitZ();
  return in;
}

/// Ticks in which a force was felt, of `ticks`.
template <typename Each>
int felt(const AugmentationPlan& plan, int ticks, Each each) {
  AugmentationState state;
  int count = 0;
  for (int i = 0; i < ticks; ++i) {
    AugmentationInput in = upward();
    in.now_ns = i * 1'000'000;
    each(i, in);
    count += augment(plan, in, &state).f.norm() > 0;
  }
  return count;
}

TEST(Augmentation, APulseHasItsWidthWhateverTriggeredIt) {
  const AugmentationPlan plan = planOf(pulseOn(Augmentation::Trigger::bump));
  EXPECT_EQ(felt(plan, 100, [](int i, AugmentationInput& in) { in.bump = i == 20; }), 10);
  EXPECT_EQ(felt(plan, 100, [](int i, AugmentationInput& in) { in.bump = i == 20 || i == 25; }),
            10);  // one ends before the next begins
  EXPECT_EQ(felt(plan, 100, [](int i, AugmentationInput& in) { in.bump = i == 20 || i == 40; }),
            20);
}

TEST(Augmentation, ARiseThatLastsIsOnePulse) {
  const AugmentationPlan plan = planOf(pulseOn(Augmentation::Trigger::rise));
  EXPECT_EQ(felt(plan, 200, [](int i, AugmentationInput& in) { in.rise = i >= 20 && i < 120; }),
            10);
  EXPECT_EQ(felt(plan, 200, [](int i, AugmentationInput& in) { in.rise = i >= 20 && i % 50 < 25; }),
            40);  // at 20 (still on), 50, 100, 150
}

TEST(Augmentation, AnEventTriggersOnlyItsOwn) {
  Augmentation a = pulseOn(Augmentation::Trigger::event);
  a.events = 4;
  EXPECT_EQ(felt(planOf(a), 50, [](int i, AugmentationInput& in) { in.events = i == 5 ? 2u : 0u; }),
            0);
  EXPECT_EQ(felt(planOf(a), 50, [](int i, AugmentationInput& in) { in.events = i == 5 ? 6u : 0u; }),
            10);
}

TEST(Augmentation, APulseBelongsToItsPart) {
  AugmentationPlan plan = planOf(pulseOn(Augmentation::Trigger::bump));
  plan.each[0].subtask = 0;
  plan.subtasks.count = 1;
  plan.subtasks.each[0].count = 1;
  plan.subtasks.each[0].conditions[0] = {
      Signal::floor_texture, Condition::Compare::at_least, 0, {}, 1, 0};
  EXPECT_EQ(felt(plan, 50, [](int i, AugmentationInput& in) { in.bump = i == 5; }), 0);
  EXPECT_EQ(felt(plan, 50,
                 [](int i, AugmentationInput& in) {
                   in.bump = i == 5;
                   in.signals[Signal::floor_texture] = 1;
                 }),
            10);
}

TEST(Augmentation, APulseOfAPartsBeginning) {
  AugmentationPlan plan = planOf(pulseOn(Augmentation::Trigger::begin));
  plan.each[0].subtask = 0;
  plan.subtasks.count = 1;
  plan.subtasks.each[0].count = 1;
  plan.subtasks.each[0].conditions[0] = {
      Signal::bone_force, Condition::Compare::at_least, 0, {}, 0.5, 0.05};
  EXPECT_EQ(felt(plan, 100,
                 [](int i, AugmentationInput& in) {
                   in.signals[Signal::bone_force] = i > 30 && i < 60 ? 1 : 0;
                 }),
            10);
}

TEST(Augmentation, TheAttractionIsTheFormula) {
  constexpr double kF = 10, kReach = 0.3e-3, kRadius = 2;
  EXPECT_EQ(attractionForce(kF, 0, kReach, kRadius), 0);
  EXPECT_NEAR(attractionForce(kF, kReach, kReach, kRadius), 0, 1e-12);
  EXPECT_EQ(attractionForce(kF, 1.001 * kReach, kReach, kRadius), 0);
  EXPECT_NEAR(attractionForce(kF, kReach / 2, kReach, kRadius), 2 * kF / kRadius, 1e-12);
  const double h = 1e-9, steepest = 2 * std::numbers::pi * kF / (kReach * kRadius);
  EXPECT_NEAR((attractionForce(kF, kReach / 4 + h, kReach, kRadius) -
               attractionForce(kF, kReach / 4 - h, kReach, kRadius)) /
                  (2 * h),
              steepest, 1e-3 * steepest);
  EXPECT_NEAR(steepest, 104'720, 1);  // N/m, as printed: no device holds it
  double last = 0, bend = 0;
  for (int i = 1; i <= 1000; ++i) {
    const double f = attractionForce(kF, kReach * i / 1000, kReach, kRadius);
    bend = std::max(bend, std::abs(f - last));
    last = f;
  }
  EXPECT_LT(bend, 1.01 * steepest * kReach / 1000);
}

AugmentationPlan attractionPlan(double steepest) {
  Augmentation a;
  a.kind = AugmentationKind::attraction;
  a.amplitude = 10;
  a.reach = 0.3e-3;
  a.blend_s = 0;
  AugmentationPlan plan = planOf(a);
  plan.steepest = steepest;
  return plan;
}

Vec3 attractionAt(const AugmentationPlan& plan, double d) {
  AugmentationState state;
  AugmentationInput in = upward();
  in.to_valley = Vec3(-d, 0, 0);
  in.valley_radius = 2;
  return augment(plan, in, &state).f;
}

TEST(Augmentation, TheAttractionPullsTowardTheValleyNoSteeperThanTheDeviceHolds) {
  const AugmentationPlan printed = attractionPlan(1e9), held = attractionPlan(5000);
  for (const double d : {0.01e-3, 0.1e-3, 0.15e-3, 0.29e-3}) {
    EXPECT_NEAR(attractionAt(printed, d).x(), -attractionForce(10, d, 0.3e-3, 2), 1e-9);
    EXPECT_EQ(attractionAt(printed, d).z(), 0);
  }
  double steepest = 0;
  for (int i = 0; i < 300; ++i)
    steepest = std::max(
        steepest,
        std::abs(attractionAt(held, (i + 1) * 1e-6).x() - attractionAt(held, i * 1e-6).x()) / 1e-6);
  EXPECT_LT(steepest, 5000.001);
  EXPECT_GT(steepest, 4900);
  EXPECT_NEAR(-attractionAt(held, 0.15e-3).x(),
              2 * (5000 * 0.3e-3 * 2 / (2 * std::numbers::pi)) / 2, 1e-9);
}

TEST(Augmentation, BlendsInAndOutEvenly) {
  AugmentationPlan plan = attractionPlan(1e9);
  plan.each[0].blend_s = 0.02;
  plan.each[0].subtask = 0;
  plan.subtasks.count = 1;
  plan.subtasks.each[0].count = 1;
  plan.subtasks.each[0].conditions[0] = {
      Signal::floor_contact, Condition::Compare::at_least, 0, {}, 1, 0};
  AugmentationState state;
  double last = 0, jump = 0;
  for (int i = 0; i < 200; ++i) {
    AugmentationInput in = upward();
    in.to_valley = Vec3(0.15e-3, 0, 0);
    in.valley_radius = 2;
    in.signals[Signal::floor_contact] = i >= 50 && i < 120;
    const double f = augment(plan, in, &state).f.norm();
    jump = std::max(jump, std::abs(f - last));
    last = f;
    if (i == 100) {
      EXPECT_NEAR(f, 10, 1e-9);
    }
    if (i == 199) {
      EXPECT_EQ(f, 0);
    }
  }
  EXPECT_NEAR(jump, 10 * 0.05, 1e-9);
}

TEST(Augmentation, AVibrationFollowsTimeOrPlace) {
  Augmentation a;
  a.kind = AugmentationKind::vibration;
  a.amplitude = 0.5;
  a.frequency_Hz = 50;
  a.blend_s = 0;
  AugmentationState state;
  double peak = 0, sum = 0;
  for (int i = 0; i < 200; ++i) {
    const double f = augment(planOf(a), upward(), &state).f.z();
    peak = std::max(peak, f);
    sum += f;
  }
  EXPECT_NEAR(peak, 0.5, 0.01);
  EXPECT_NEAR(sum, 0, 0.01);
  a.wavelength = 1e-3;
  state = {};
  for (int i = 0; i < 50; ++i)
    EXPECT_NEAR(augment(planOf(a), upward(), &state).f.z(), 0, 1e-12);  // it stands still
  AugmentationInput in = upward();
  in.dp = Vec3(0.25e-3, 0, 0.5);  // up and down does not count
  EXPECT_NEAR(augment(planOf(a), in, &state).f.z(), 0.5, 1e-9);
}

TEST(Augmentation, AnExaggerationAddsOnlyWhatChangesFast) {
  Augmentation a;
  a.kind = AugmentationKind::exaggeration;
  a.amplitude = 2;
  a.tau_s = 0.05;
  a.blend_s = 0;
  AugmentationState state;
  AugmentationInput in = upward();
  in.f_contact = Vec3(0, 0, 1);
  EXPECT_NEAR(augment(planOf(a), in, &state).f.norm(), 0, 1e-12);
  in.f_contact = Vec3(0, 0, 0.2);  // a wall gives way
  const Vec3 f = augment(planOf(a), in, &state).f;
  EXPECT_NEAR(f.z(), -2 * 0.8 * (0.05 / 0.051), 1e-9);
  for (int i = 0; i < 500; ++i) augment(planOf(a), in, &state);
  EXPECT_NEAR(augment(planOf(a), in, &state).f.norm(), 0, 1e-4);
}

TEST(Augmentation, AFixturePullsToItsLine) {
  Augmentation a;
  a.kind = AugmentationKind::fixture;
  a.amplitude = 300;
  a.blend_s = 0;
  AugmentationPlan plan = planOf(a);
  AugmentationInput in = upward();
  in.to_line = Vec3(0.002, 0, 0);
  AugmentationState state;
  EXPECT_NEAR(augment(plan, in, &state).f.x(), 0.6, 1e-12);
  plan.steepest = 100;
  EXPECT_NEAR(augment(plan, in, &state).f.x(), 0.2, 1e-12);
}

Augmentation reliefOf(double blend_s) {
  Augmentation a;
  a.kind = AugmentationKind::relief;
  a.trigger = Augmentation::Trigger::bump;
  a.amplitude = 0.8;
  a.blend_s = blend_s;
  return a;
}

/// As long as the footprint is there and as high as it is, at once, whatever the probe does.
TEST(Augmentation, AReliefIsTheFootprintAlongItsWay) {
  const AugmentationPlan plan = planOf(reliefOf(0));
  AugmentationState state;
  for (const double footprint : {0.0, 0.5, 1.0, 1.0, 0.25, 0.0}) {
    AugmentationInput in = upward();
    in.footprint = footprint;
    in.v = Vec3(0.3, 0, -0.1);
    const Augmented out = augment(plan, in, &state);
    EXPECT_EQ(out.f, Vec3(0, 0, 0.8 * footprint)) << footprint;
    EXPECT_EQ(out.active, footprint > 0 ? 1u : 0u);
  }
}

TEST(Augmentation, AReliefGoesAnyOfTheWays) {
  AugmentationInput in = upward();
  in.footprint = 0.5;
  in.v = Vec3(0.3, 0, -0.4);
  in.tool = Vec3::UnitY();
  const auto along = [&](Augmentation::Way way) {
    Augmentation a = reliefOf(0);
    a.way = way;
    AugmentationState state;
    return augment(planOf(a), in, &state).f;
  };
  using Way = Augmentation::Way;
  EXPECT_LT((along(Way::against_motion) - Vec3(-0.24, 0, 0.32)).norm(), 1e-12);
  EXPECT_LT((along(Way::along_tool) - Vec3(0, 0.4, 0)).norm(), 1e-12);
  EXPECT_LT((along(Way::against_tool) - Vec3(0, -0.4, 0)).norm(), 1e-12);
}

TEST(Augmentation, AReliefBlendsInAndOutWithItsPart) {
  AugmentationPlan plan = planOf(reliefOf(0.02));
  plan.each[0].subtask = 0;
  plan.subtasks.count = 1;
  plan.subtasks.each[0].count = 1;
  plan.subtasks.each[0].conditions[0] = {
      Signal::floor_texture, Condition::Compare::at_least, 0, {}, 1, 0};
  AugmentationState state;
  for (int i = 0; i < 100; ++i) {
    AugmentationInput in = upward();
    in.footprint = 0.5;
    in.signals[Signal::floor_texture] = i >= 10 && i < 60;
    const double weight = i < 10   ? 0
                          : i < 60 ? std::min(1.0, (i - 9) / 20.0)
                                   : std::max(0.0, 1 - (i - 59) / 20.0);
    EXPECT_NEAR(augment(plan, in, &state).f.z(), weight * 0.4, 1e-12) << i;
  }
}

TEST(Augmentation, AReliefBeginsOnEachBumpThatIsEntered) {
  AugmentationPlan plan = planOf(reliefOf(0.02));
  plan.each[0].subtask = 0;
  plan.subtasks.count = 1;
  plan.subtasks.each[0].count = 1;
  plan.subtasks.each[0].conditions[0] = {
      Signal::floor_texture, Condition::Compare::at_least, 0, {}, 1, 0};
  AugmentationState state;
  for (int i = 0; i < 60; ++i) {
    AugmentationInput in = upward();
    in.signals[Signal::floor_texture] = i >= 20;
    in.footprint = 1;
    in.bump = i == 5 || i == 30 || i == 33;
    EXPECT_EQ(augment(plan, in, &state).began, i == 30 || i == 33 ? 1u : 0u) << i;
  }
}

TEST(Augmentation, AReliefIsASource) {
  AugmentationPlan plan = planOf(reliefOf(0));
  AugmentationState state;
  AugmentationInput in = upward();
  in.footprint = 0.5;
  EXPECT_LT((augment(plan, in, &state).f_source - Vec3(0, 0, 0.4)).norm(), 1e-12);
  plan.largest = 0.1;  // of what is felt
  EXPECT_LT((augment(plan, in, &state).f_source - Vec3(0, 0, 0.1)).norm(), 1e-12);
}

TEST(Augmentation, AllTogetherNeverExceedTheLimit) {
  AugmentationPlan plan = planOf(pulseOn(Augmentation::Trigger::bump));
  plan.each[0].amplitude = 30;
  plan.each[1] = attractionPlan(1e9).each[0];
  plan.each[2] = plan.each[1];
  plan.count = 3;
  plan.largest = 3.3;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  AugmentationState state;
  double largest = 0;
  for (int i = 0; i < 20'000; ++i) {
    AugmentationInput in = upward();
    in.bump = any(random) > 0.9;
    in.to_valley = 3e-4 * Vec3(any(random), any(random), 0);
    in.valley_radius = 2;
    in.v = Vec3(any(random), any(random), any(random));
    largest = std::max(largest, augment(plan, in, &state).f.norm());
  }
  EXPECT_LE(largest, 3.3 + 1e-12);
  EXPECT_GT(largest, 3.2);
}

TEST(Augmentation, NotAllowedIsExactlyNothingAndForgets) {
  AugmentationPlan plan = attractionPlan(1e9);
  plan.each[1] = pulseOn(Augmentation::Trigger::bump);
  plan.count = 2;
  AugmentationState state;
  AugmentationInput in = upward();
  in.to_valley = Vec3(1e-4, 0, 0);
  in.valley_radius = 2;
  in.bump = true;
  EXPECT_GT(augment(plan, in, &state).f.norm(), 0);
  in.allowed = false;
  const Augmented off = augment(plan, in, &state);
  EXPECT_EQ(off.f, Vec3(Vec3::Zero()));
  EXPECT_EQ(off.active | off.began, 0u);
  EXPECT_EQ(off.f_source, Vec3(Vec3::Zero()));
  in.allowed = true;
  in.bump = false;
  in.valley_radius = 0;
  EXPECT_EQ(augment(plan, in, &state).f, Vec3(Vec3::Zero()));  // the pulse was over
}

TEST(Augmentation, OnlyWhatHeedsNoMotionIsASource) {
  AugmentationPlan plan = planOf(pulseOn(Augmentation::Trigger::bump));
  AugmentationState state;
  AugmentationInput in = upward();
  in.bump = true;
  EXPECT_LT((augment(plan, in, &state).f_source - Vec3(0, 0, 0.8)).norm(), 1e-12);
  AugmentationState other;
  AugmentationInput pulled = upward();
  pulled.to_valley = Vec3(1e-4, 0, 0);
  pulled.valley_radius = 2;
  const Augmented field = augment(attractionPlan(1e9), pulled, &other);
  EXPECT_GT(field.f.norm(), 0);
  EXPECT_EQ(field.f_source, Vec3(Vec3::Zero())) << "a field is watched like any contact";
}

}  // namespace
}  // namespace palpa::haptics

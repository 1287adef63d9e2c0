#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "haptics/augmentation/augmentation.h"

/// Guides, walls, what fades, and a steadied hand.
namespace palpa::haptics {
namespace {

AugmentationPlan fixturePlan(const Augmentation& a) {
  AugmentationPlan plan;
  plan.each[0] = a;
  plan.count = 1;
  plan.largest = 100;
  plan.steepest = 1e9;
  return plan;
}

TEST(Fixtures, AFixtureWithAReachDrawsNobodyFromAfar) {
  Augmentation a;
  a.kind = AugmentationKind::fixture;
  a.amplitude = 300;
  a.reach = 0.010;
  a.blend_s = 0;
  AugmentationInput in;
  AugmentationState state;
  double before = 0;
  for (int i = 1; i <= 150; ++i) {
    const double d = 1e-4 * i, share = std::max(0.0, 1 - d * d / 1e-4);
    in.to_line = Vec3(d, 0, 0);
    const double f = augment(fixturePlan(a), in, &state).f.x();
    EXPECT_NEAR(f, 300 * d * share * share, 1e-12);
    EXPECT_LE(std::abs(f - before), 300 * 1e-4 + 1e-12) << "steeper than its spring";
    before = f;
  }
  EXPECT_EQ(before, 0);
}

TEST(Fixtures, AKeepOutPushesOutOfWhatWasEntered) {
  Augmentation a;
  a.kind = AugmentationKind::keep_out;
  a.amplitude = 500;
  a.blend_s = 0;
  AugmentationPlan plan = fixturePlan(a);
  AugmentationInput in;
  AugmentationState state;
  EXPECT_EQ(augment(plan, in, &state).f, Vec3(Vec3::Zero()));
  in.out_of = Vec3(0, 0.001, 0);
  EXPECT_NEAR(augment(plan, in, &state).f.y(), 0.5, 1e-12);
  plan.steepest = 200;
  EXPECT_NEAR(augment(plan, in, &state).f.y(), 0.2, 1e-12);
}

/// What fades is felt by its share, and with none not at all; what does not fade knows no share.
TEST(Fixtures, WhatFadesIsFeltByItsShare) {
  for (const AugmentationKind kind : {AugmentationKind::fixture, AugmentationKind::keep_out})
    for (const bool fades : {false, true}) {
      Augmentation a;
      a.kind = kind;
      a.amplitude = 300;
      a.blend_s = 0;
      a.fades = fades;
      AugmentationInput in;
      in.to_line = in.out_of = Vec3(0.002, 0, 0);
      for (const double support : {1.0, 0.5, 0.0, -1.0, std::nan("")}) {
        AugmentationState state;
        in.support = support;
        const Augmented now = augment(fixturePlan(a), in, &state);
        const double share = !fades ? 1 : support > 0 ? support : 0;
        EXPECT_NEAR(now.f.x(), 0.6 * share, 1e-12) << support;
        EXPECT_EQ(now.active, share > 0 ? 1u : 0u);
        EXPECT_EQ(now.f_source.norm(), 0);
      }
    }
}

Augmentation steadyingOf(double from_Hz, double to_Hz) {
  Augmentation a;
  a.kind = AugmentationKind::steadying;
  a.amplitude = 20;
  a.from_Hz = from_Hz;
  a.to_Hz = to_Hz;
  a.blend_s = 0;
  return a;
}

/// N s/m: force over speed where the tip moves to and fro at f Hz, once it is settled.
double dampingAt(double f) {
  const AugmentationPlan plan = fixturePlan(steadyingOf(8, 12));
  AugmentationState state;
  double force = 0, speed = 0;
  for (int i = 0; i < 4000; ++i) {
    AugmentationInput in;
    in.dp = Vec3(1e-5 * std::cos(2 * std::numbers::pi * f * 1e-3 * i), 0, 0);
    const Vec3 f_now = augment(plan, in, &state).f;
    if (i < 2000) continue;
    force = std::max(force, f_now.norm());
    speed = std::max(speed, in.dp.norm() / in.dt);
  }
  return force / speed;
}

TEST(Fixtures, ASteadyingDampsItsBandAlone) {
  EXPECT_NEAR(dampingAt(std::sqrt(96.0)), 20, 0.1);
  EXPECT_NEAR(dampingAt(8), 20 / std::sqrt(2.0), 0.2);
  EXPECT_NEAR(dampingAt(12), 20 / std::sqrt(2.0), 0.2);
  EXPECT_LT(dampingAt(1), 0.9);  // 20 * 0.41 / (9.8 - 1/9.8) and no more
  EXPECT_LT(dampingAt(100), 1);
}

/// However the tip moves, what is taken from it is never given back: the law is passive.
TEST(Fixtures, ASteadyingGivesNoEnergy) {
  std::mt19937 draws(7);
  std::normal_distribution<double> normal;
  for (const double rest : {0.0, 0.9, 0.999}) {
    const AugmentationPlan plan = fixturePlan(steadyingOf(8, 12));
    AugmentationState state;
    double given = 0, v = 0;
    for (int i = 0; i < 20000; ++i) {
      AugmentationInput in;
      v = rest * v + normal(draws) * 1e-5;
      in.dp = Vec3(v, 0, 0);
      given += augment(plan, in, &state).f.dot(in.dp);
      EXPECT_LE(given, 1e-15) << i;
    }
    EXPECT_LT(given, -1e-9);
  }
}

TEST(Fixtures, ASteadyingWithoutABandOrAllowanceIsExactlyZero) {
  AugmentationState state;
  AugmentationInput in;
  in.dp = Vec3(1e-4, 0, 0);
  EXPECT_EQ(augment(fixturePlan(steadyingOf(0, 0)), in, &state).f, Vec3(Vec3::Zero()));
  EXPECT_EQ(augment(fixturePlan(steadyingOf(12, 8)), in, &state).f, Vec3(Vec3::Zero()));
  in.allowed = false;
  const Augmented now = augment(fixturePlan(steadyingOf(8, 12)), in, &state);
  EXPECT_EQ(now.f, Vec3(Vec3::Zero()));
  EXPECT_EQ(now.active, 0u);
}

}  // namespace
}  // namespace palpa::haptics

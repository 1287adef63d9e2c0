#include "haptics/materials/force_laws.h"

#include <gtest/gtest.h>

#include "tests/support/allocation_count.h"

namespace palpa::haptics {
namespace {

const Dahl kRubber{0.8, 2000, 1.5};
constexpr double kTick = 1e-3;

/// One straight stroke in one plane, in steps of any size, is the closed form.
TEST(Dahl, AStraightStrokeIsExactAtAnyStep) {
  const double f_n = 1.2, way = 0.003, limit = kRubber.mu * f_n;
  for (const int steps : {1, 3, 1000}) {
    DahlState state;
    for (int i = 0; i < steps; ++i)
      dragOf({kRubber.mu, kRubber.sigma, 0}, {way / steps, 0, 0}, Vec3::UnitZ(), f_n, kTick,
             &state);
    EXPECT_NEAR(state.F[0], limit * (1 - std::exp(-kRubber.sigma * way / limit)), 1e-12) << steps;
  }
}

/// Back after a reversal: F = -F_c + (F_r + F_c) exp(-sigma x / F_c); the loop closes and is not
/// passed through again for nothing.
TEST(Dahl, AReversalTurnsTheForceAndDissipates) {
  const double f_n = 1, limit = kRubber.mu * f_n;
  const Dahl dry{kRubber.mu, kRubber.sigma, 0};
  DahlState state;
  double work = 0, x = 0;
  for (int stroke = 0; stroke < 6; ++stroke) {
    const double from = state.F[0], sign = stroke % 2 ? -1 : 1;
    for (int i = 0; i < 200; ++i) {
      const double before = state.F[0];
      dragOf(dry, {sign * 1e-5, 0, 0}, Vec3::UnitZ(), f_n, kTick, &state);
      work += 0.5 * (before + state.F[0]) * sign * 1e-5;
      x += sign * 1e-5;
    }
    EXPECT_NEAR(state.F[0],
                sign * limit + (from - sign * limit) * std::exp(-kRubber.sigma * 0.002 / limit),
                1e-12);
  }
  EXPECT_NEAR(x, 0, 1e-12);
  EXPECT_GT(work, 0.5 * 6 * 0.002 * limit);  // most of a slide's F_c x is lost
}

TEST(Dahl, StaysWithinCoulombAndIsStableInTheLightestContact) {
  DahlState state;
  for (const double f_n : {1.0, 1e-3, 1e-9}) {
    for (int i = 0; i < 100; ++i) {
      dragOf(kRubber, {1e-3 * std::cos(i), 1e-3 * std::sin(2.0 * i), 5e-4}, Vec3::UnitZ(), f_n,
             kTick, &state);
      EXPECT_LE(unpack(state.F).norm(), kRubber.mu * f_n * (1 + 1e-12));
    }
  }
}

TEST(Dahl, OffContactItForgetsAtRestItHolds) {
  DahlState state;
  dragOf(kRubber, {0.001, 0, 0}, Vec3::UnitZ(), 1, kTick, &state);
  const Packed3 held = state.F;
  EXPECT_EQ(dragOf(kRubber, Vec3::Zero(), Vec3::UnitZ(), 1, kTick, &state), unpack(held));
  EXPECT_EQ(dragOf(kRubber, {1, 1, 1}, Vec3::UnitZ(), 0, kTick, &state), Vec3::Zero());
  EXPECT_EQ(unpack(state.F), Vec3::Zero());
}

/// Across a bulge the force lies in the surface, as large as before.
TEST(Dahl, TurnsWithTheSurface) {
  DahlState state;
  dragOf(kRubber, {0.001, 0, 0}, Vec3::UnitZ(), 1, kTick, &state);
  const double size = unpack(state.F).norm();
  const Vec3 n = Vec3(0.3, 0.1, 1).normalized();
  const Vec3 drag = dragOf(kRubber, Vec3::Zero(), n, 1, kTick, &state);
  EXPECT_NEAR(drag.dot(n), 0, 1e-12);
  EXPECT_NEAR(drag.norm(), size, 1e-12);
}

/// Which way is which does not matter.
TEST(Dahl, DoesNotDependOnTheFrame) {
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  DahlState one, other;
  for (int i = 0; i < 200; ++i) {
    const Vec3 dp(1e-4 * std::cos(0.1 * i), 1e-4 * std::sin(0.17 * i), 2e-5);
    const Vec3 a = dragOf(kRubber, dp, Vec3::UnitZ(), 0.7, kTick, &one),
               b = dragOf(kRubber, R * dp, R.col(2), 0.7, kTick, &other);
    EXPECT_LT((R * a - b).norm(), 1e-12);
  }
}

TEST(Dahl, NeverAllocates) {
  DahlState state;
  const NoAllocation guard;
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < 1000; ++i)
    sum += dragOf(kRubber, {1e-5 * i, -1e-5, 0}, Vec3::UnitZ(), 0.5, kTick, &state);
  EXPECT_TRUE(sum.allFinite());
  EXPECT_EQ(guard.allocations(), 0);
}

TEST(HuntCrossley, DepthIsTheInverseOfForce) {
  for (const HuntCrossley& law :
       {HuntCrossley{2000, 3000, 1.4}, HuntCrossley{500, 0, 1}, HuntCrossley{9000, 800, 2}})
    for (const double x : {1e-5, 0.001, 0.01, 0.03})
      for (const double rate : {-0.5, -0.1, 0.0, 0.1, 0.5})
        EXPECT_NEAR(depthOf(law, forceOf(law, x, rate), rate), x, 1e-12 + 1e-9 * x);
}

TEST(HuntCrossley, StiffnessIsItsDerivativeAndNothingPulls) {
  const HuntCrossley law{2000, 3000, 1.4};
  for (const double rate : {-1.0, 0.0, 0.3}) {
    const double h = 1e-7;
    EXPECT_NEAR(stiffnessOf(law, 0.01, rate),
                (forceOf(law, 0.01 + h, rate) - forceOf(law, 0.01 - h, rate)) / (2 * h), 1e-3);
    EXPECT_GT(forceOf(law, 0.01, rate), 0);
  }
  EXPECT_EQ(forceOf(law, 0, 1), 0);
  EXPECT_EQ(forceOf(law, -0.01, 1), 0);
  EXPECT_EQ(depthOf(law, -1, 0), 0);
}

}  // namespace
}  // namespace palpa::haptics

#include <gtest/gtest.h>

#include "needle_bench.h"

namespace palpa::haptics {
namespace {

TEST(NeedleContact, OutsideThereIsNoForce) {
  NeedleBench bench;
  const NeedleContact c = bench.at({0, 0, 0.01});
  EXPECT_EQ(c.f_D.norm(), 0);
  EXPECT_EQ(bench.state.phase, NeedlePhase::outside);
}

TEST(NeedleContact, SkinAndCouplingAreInSeries) {
  NeedleBench bench;
  const double x = 0.0025;
  const NeedleContact c = bench.atDepth(x);
  const double F = bench.materials.skin.force(c.indentation);
  EXPECT_NEAR(F, bench.coupling.stiffness * (x - c.indentation), 1e-6);  // N; Newton stops at 1e-12 m
  EXPECT_NEAR(c.f_D.z(), F, 1e-12);
  EXPECT_GT(c.f_D.z(), 0);
}

TEST(NeedleContact, NoSlopeIsSteeperThanTheCoupling) {
  NeedleBench bench;
  bench.puncture_N = 100;
  double last = 0;
  for (double x = 0; x < 0.006; x += 1e-5) {
    const double f = bench.atDepth(x).f_D.z();
    EXPECT_LE((f - last) / 1e-5, bench.coupling.stiffness * (1 + 1e-6));
    EXPECT_GE(f, last);
    last = f;
  }
}

TEST(NeedleContact, SkinGivesWayAtItsThresholdAndReleasesWithoutAStep) {
  NeedleBench bench;
  double before = 0, after = 0;
  bool punctured = false;
  double x = 0;
  for (; x < 0.006 && !punctured; x += 1e-5) {
    const NeedleContact c = bench.atDepth(x);
    punctured = c.events & kSkinPunctured;
    before = c.f_D.z();
  }
  ASSERT_TRUE(punctured);
  EXPECT_NEAR(before, bench.puncture_N, 0.02);  // N: one 10 um step of the steepest slope, 1000 N/m, twice
  after = bench.atDepth(x).f_D.z();
  // The first tick after keeps exp(-1 ms / 10 ms) of the stored force; tissue adds a little.
  EXPECT_NEAR(after, before * std::exp(-0.1), 0.1);
  bench.settle(x, 100);
  EXPECT_LT(bench.atDepth(x).f_D.z(), 0.5 * before);
  EXPECT_EQ(bench.state.skin_punctures, 1);
}

TEST(NeedleContact, LayersComeInOrder) {
  NeedleBench bench;
  bench.move(0, 0.005);
  EXPECT_EQ(bench.atDepth(0.005).tissue, Tissue::fat);
  bench.move(0.005, 0.015);
  EXPECT_EQ(bench.atDepth(0.015).tissue, Tissue::muscle);
}

TEST(NeedleContact, AWallHoldsTheTipUntilItsPeakThenGivesWay) {
  NeedleBench bench;
  bench.move(0, 0.0205);
  NeedleContact c = bench.atDepth(0.0205);
  EXPECT_EQ(c.wall, Organ::vein);
  EXPECT_FALSE(c.wall_leaving);
  EXPECT_EQ(c.tissue, Tissue::muscle);              // still before the wall
  EXPECT_NEAR(c.wall_force, 400 * 0.0005, 0.01);    // N: one 10 um step of the motion
  bench.move(0.0205, 0.0215);                       // peak 0.4 N at 1 mm
  c = bench.atDepth(0.0215);
  EXPECT_EQ(c.tissue, Tissue::vein_lumen);
  EXPECT_EQ(c.wall, Organ::none);
}

TEST(NeedleContact, TheBackWallIsAnotherWallAndAWithdrawnTipHeals) {
  NeedleBench bench;
  bench.move(0, 0.0312);
  EXPECT_EQ(bench.atDepth(0.0312).tissue, Tissue::muscle);   // through and through
  EXPECT_NE(bench.state.walls_back, 0u);
  bench.move(0.0312, 0.015);
  bench.settle(0.015, 5);
  EXPECT_EQ(bench.state.walls_front, 0u);
  EXPECT_EQ(bench.state.walls_back, 0u);
  bench.move(0.015, 0.0205);
  EXPECT_EQ(bench.atDepth(0.0205).wall, Organ::vein);        // it has to be punctured again
}

TEST(NeedleContact, FrictionOpposesMotionBothWays) {
  NeedleBench bench;
  bench.move(0, 0.012);
  EXPECT_GT(bench.move(0.012, 0.016).f_D.z(), 0.2);    // cutting 0.3 N and friction push back
  const double back = bench.move(0.016, 0.012).f_D.z();
  EXPECT_LT(back, 0);                                   // withdrawing: friction only, the other way
  EXPECT_GT(back, -0.3);
}

TEST(NeedleContact, HoldsTheNeedleAboutItsEntry) {
  NeedleBench bench;
  bench.move(0, 0.012);
  bench.settle(0.012);
  const NeedleContact c = bench.at({0.001, 0, -0.012});
  const double k = bench.materials.lateral_stiffness + bench.materials.lateral_per_depth * 0.012;
  EXPECT_NEAR(c.f_D.x(), -k * 0.001, 0.02 * k * 0.001);  // the insertion differs by the indentation, < 2 %
}

TEST(NeedleContact, WithdrawalEndsTheContact) {
  NeedleBench bench;
  bench.move(0, 0.012);
  std::uint32_t events = 0;
  for (double d = 0.012; d > -0.003; d -= 1e-5) events |= bench.atDepth(d).events;
  EXPECT_TRUE(events & kWithdrawn);
  EXPECT_EQ(bench.state.phase, NeedlePhase::outside);
  EXPECT_EQ(bench.atDepth(-0.003).f_D.norm(), 0);
}

TEST(NeedleContact, BonePushesTheShaftAwayAlongTheNormal) {
  NeedleBench bench;
  bench.move(0, 0.012);
  bench.settle(0.012);
  bench.geometry.bones[0] = {{0.0065, -0.05, -0.008}, {0.0065, 0.05, -0.008}, 0.006, Organ::clavicle};
  bench.geometry.bone_count = 1;
  const NeedleContact c = bench.atDepth(0.012);
  const double penetration = 0.006 + bench.materials.needle_radius - 0.0065;
  EXPECT_NEAR(c.bone_force, bench.coupling.stiffness * penetration, 1e-9);
  EXPECT_LT(c.f_D.x(), 0);
  EXPECT_TRUE(c.events & kBoneTouched);
  EXPECT_EQ(bench.state.bone, Organ::clavicle);
}

TEST(NeedleContact, TheMissingTorqueIsAboutTheGimbal) {
  NeedleBench bench;
  bench.move(0, 0.012);
  bench.settle(0.012);
  const NeedleContact c = bench.at({0.001, 0, -0.012});
  // The lateral hold acts at the entry, 0.098 m below the gimbal: tau = r x f.
  EXPECT_NEAR(c.tau_D.y(), -0.098 * c.f_D.x(), 0.02 * std::abs(0.098 * c.f_D.x()));
}

}  // namespace
}  // namespace palpa::haptics

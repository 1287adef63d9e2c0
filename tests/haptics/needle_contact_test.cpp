#include <gtest/gtest.h>

#include <vector>

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
  bench.commands.puncture_force_N = 100;
  bench.atDepth(0);
  const NeedleContact c = bench.atDepth(x);
  const double F = bench.materials.skin.force(c.indentation);
  EXPECT_NEAR(F, bench.coupling.stiffness * (x - c.indentation),
              1e-6);  // N; Newton stops at 1e-12 m
  EXPECT_NEAR(c.f_D.z(), F, 1e-12);
  EXPECT_GT(c.f_D.z(), 0);
}

TEST(NeedleContact, NoSlopeIsSteeperThanTheCoupling) {
  NeedleBench bench;
  bench.commands.puncture_force_N = 100;
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
  EXPECT_NEAR(before, bench.commands.puncture_force_N,
              0.02);  // N: one 10 um step of the steepest slope, 1000 N/m, twice
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
  EXPECT_EQ(c.tissue, Tissue::muscle);            // still before the wall
  EXPECT_NEAR(c.wall_force, 400 * 0.0005, 0.01);  // N: one 10 um step of the motion
  bench.move(0.0205, 0.0215);                     // peak 0.4 N at 1 mm
  c = bench.atDepth(0.0215);
  EXPECT_EQ(c.tissue, Tissue::vein_lumen);
  EXPECT_EQ(c.wall, Organ::none);
}

TEST(NeedleContact, TheBackWallIsAnotherWallAndAWithdrawnTipHeals) {
  NeedleBench bench;
  bench.move(0, 0.0312);
  EXPECT_EQ(bench.atDepth(0.0312).tissue, Tissue::muscle);  // through and through
  EXPECT_NE(bench.state.walls_back, 0u);
  bench.move(0.0312, 0.015);
  bench.settle(0.015, 5);
  EXPECT_EQ(bench.state.walls_front, 0u);
  EXPECT_EQ(bench.state.walls_back, 0u);
  bench.move(0.015, 0.0205);
  EXPECT_EQ(bench.atDepth(0.0205).wall, Organ::vein);  // it has to be punctured again
}

TEST(NeedleContact, FrictionOpposesMotionBothWays) {
  NeedleBench bench;
  bench.move(0, 0.012);
  EXPECT_GT(bench.move(0.012, 0.016).f_D.z(), 0.2);  // cutting 0.3 N and friction push back
  const double back = bench.move(0.016, 0.012).f_D.z();
  EXPECT_LT(back, 0);  // withdrawing: friction only, the other way
  EXPECT_GT(back, -0.3);
}

TEST(NeedleContact, HoldsTheNeedleAboutItsEntry) {
  NeedleBench bench;
  bench.move(0, 0.012);
  bench.settle(0.012);
  const NeedleContact c = bench.at({0.001, 0, -0.012});
  const double k = bench.materials.lateral_stiffness + bench.materials.lateral_per_depth * 0.012;
  EXPECT_NEAR(c.f_D.x(), -k * 0.001,
              0.02 * k * 0.001);  // the insertion differs by the indentation, < 2 %
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

TEST(NeedleContact, WithdrawnAlongSkinThatBulgesTheNeedleIsFeltOnceItsPointWasClear) {
  NeedleBench bench;
  bench.move(0, 0.01);
  ASSERT_EQ(bench.state.phase, NeedlePhase::inserted);
  // It lies flat: 5 mm back along it are behind the entry, and still 2 mm below the surface
  bench.axis = Vec3::UnitX();
  EXPECT_TRUE(bench.at({-0.005, 0, -0.002}).events & kWithdrawn);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(bench.at({-0.005, 0, -0.004}).f_D.norm(), 0);
  EXPECT_EQ(bench.state.skin_punctures, 1);
  bench.at({-0.005, 0, 0.001});
  EXPECT_GT(bench.at({-0.005, 0, -0.001}).f_D.z(), 0);
}

TEST(NeedleContact, APointInTheAirIsOutWhereverItEntered) {
  NeedleBench bench;
  bench.move(0, 0.01);
  bench.axis =
      Vec3(1, 0, 1).normalized();  // swung out: the entry lies behind the point, along the needle
  EXPECT_FALSE(bench.at({0.003, 0, 0.003}).events & kWithdrawn);
  EXPECT_TRUE(bench.at({0.006, 0, 0.006}).events & kWithdrawn);
  EXPECT_EQ(bench.at({0.006, 0, 0.006}).depth, 0);
}

TEST(NeedleContact, BonePushesTheShaftAwayAlongTheNormal) {
  NeedleBench bench;
  bench.move(0, 0.012);
  bench.settle(0.012);
  bench.geometry.bones[0] = {
      {0.0065, -0.05, -0.008}, {0.0065, 0.05, -0.008}, 0.006, Organ::clavicle};
  bench.geometry.bone_count = 1;
  const NeedleContact c = bench.atDepth(0.012);
  const double penetration = 0.006 + bench.materials.needle_radius - 0.0065;
  EXPECT_NEAR(c.bone_force, bench.coupling.stiffness * penetration, 1e-9);
  EXPECT_LT(c.f_D.x(), 0);
  EXPECT_TRUE(c.events & kBoneTouched);
  EXPECT_EQ(bench.state.bone, Organ::clavicle);
}

TEST(NeedleContact, ANeedleThatBeginsInTheTissueFeelsNothingUntilItHasBeenOutside) {
  for (const double depth : {0.001, 0.010, 0.060}) {
    NeedleBench bench;
    for (int i = 0; i < 50; ++i) {
      const NeedleContact c = bench.atDepth(depth);
      EXPECT_EQ(c.f_D.norm(), 0);
      EXPECT_EQ(c.events, 0u);
      EXPECT_NEAR(c.depth, depth, 1e-12) << "told, so that somebody takes it out";
    }
    bench.atDepth(-0.001);
    EXPECT_GT(bench.move(0, 0.001).skin_force, 0.01) << "from now on as ever";
  }
}

TEST(NeedleContact, NeitherSkinNorWallEverGivesMoreThanWhatBreaksIt) {
  for (const double depth : {0.002, 0.010, 0.030, 0.060, 0.2}) {
    NeedleBench bench;
    bench.materials.walls[static_cast<int>(Organ::fascia)] = {500, 0.6, 0, {}};
    bench.geometry.boundaries[2].wall = Organ::fascia;
    bench.atDepth(-0.001);
    double most = 0;
    for (int i = 0; i < 100; ++i) {  // there in one step, then held
      const NeedleContact c = bench.atDepth(depth);
      most = std::max(most, c.f_D.norm());
      EXPECT_LE(c.skin_force, bench.commands.puncture_force_N + 1e-12);
      EXPECT_LE(c.wall_force, 0.6 + 1e-12);
    }
    const double friction =
        0.3 + 0.2 * 0.1 + 20 * 0.002 + 5 * 0.006 + 10 * depth;  // cutting and shaft, at most
    const double viscous = 3 * depth / 0.005;                   // the step itself
    EXPECT_LT(most, bench.commands.puncture_force_N + 0.6 + 0.4 + friction + viscous + 1) << depth;
  }
}

TEST(NeedleContact, ACapsuleWithoutLengthIsASphere) {
  const Vec3 centre(0.001, 0.002, 0.003);
  const Capsule sphere{pack(centre), pack(centre), 0.006, Organ::rib, 0, {}};
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6, 0, -0.8)}) {
    const Vec3 p = centre + 0.0055 * way;
    const BoneContact c = bonePenetration(sphere, p, p, 0.001);
    EXPECT_NEAR(c.penetration, 0.0015, 1e-12);
    EXPECT_LT((c.n_D - way).norm(), 1e-12);
  }
}

TEST(NeedleContact, AChainPushesOnceTwoBonesPushTwice) {
  NeedleBench bench;
  bench.move(0, 0.012);
  bench.settle(0.012);
  // Two links of one bone that overlap at their joint, right where the shaft touches.
  bench.geometry.bones[0] = {
      {0.0065, -0.05, -0.008}, {0.0065, 0.001, -0.008}, 0.006, Organ::rib, 4, {}};
  bench.geometry.bones[1] = {
      {0.0065, -0.001, -0.008}, {0.0065, 0.05, -0.008}, 0.006, Organ::rib, 4, {}};
  bench.geometry.bone_count = 2;
  NeedleBench two = bench;
  two.geometry.bones[1].bone = 5;
  NeedleBench none = bench;
  none.geometry.bone_count = 0;
  const double without = none.atDepth(0.012).f_D.x();
  const double once = bench.atDepth(0.012).f_D.x() - without;
  EXPECT_LT(once, -0.1);
  EXPECT_NEAR(two.atDepth(0.012).f_D.x() - without, 2 * once, 1e-12);
}

/// The bench with a fascia before the muscle, as strong as the wall of the vein.
NeedleBench withFascia() {
  NeedleBench bench;
  bench.materials.walls[static_cast<int>(Organ::fascia)] = {500, 0.6, 0, {}};
  bench.geometry.boundaries[2].wall = Organ::fascia;
  return bench;
}

TEST(NeedleContact, WallsArePuncturedOneAfterTheOtherEachAtItsOwnForce) {
  NeedleBench bench = withFascia();
  std::vector<Organ> order;
  std::vector<double> peaks;
  for (double d = 0; d < 0.035; d += 1e-5) {
    const NeedleContact c = bench.atDepth(d);
    if (!(c.events & kWallPunctured)) continue;
    order.push_back(c.wall);
    peaks.push_back(c.wall_force);
  }
  EXPECT_EQ(order, (std::vector<Organ>{Organ::fascia, Organ::vein, Organ::vein}));
  ASSERT_EQ(peaks.size(), 3u);
  EXPECT_NEAR(peaks[0], 0.6, 0.006);  // one 10 um step on 500 N/m
  EXPECT_NEAR(peaks[1], 0.4, 0.005);
  EXPECT_NEAR(peaks[2], 0.4, 0.005);
}

TEST(NeedleContact, AWallsPeakIsTheTrialsOwn) {
  for (const float scale : {0.5F, 1.5F}) {
    NeedleBench bench = withFascia();
    bench.commands.wall_scale[static_cast<int>(Organ::fascia)] = scale;
    double peak = 0;
    for (double d = 0; d < 0.014 && !(bench.state.walls_front); d += 1e-5)
      peak = bench.atDepth(d).wall_force;
    EXPECT_NEAR(peak, 0.6 * static_cast<double>(scale), 0.006);
  }
}

TEST(NeedleContact, AHeldWallRelaxes) {
  NeedleBench bench = withFascia();
  bench.materials.walls[static_cast<int>(Organ::fascia)].relaxation = {{0.2, 0.3}, {0.05, 0.5}};
  bench.move(0, 0.0085);
  const double pushed = bench.atDepth(0.0085).wall_force;
  bench.settle(0.0085, 5000);
  const double held = bench.atDepth(0.0085).wall_force;
  const double elastic = 500 * 0.0005;
  EXPECT_GT(pushed, 0.75 * elastic);        // 50 ms of pushing: the fast fifth is mostly gone
  EXPECT_NEAR(held, 0.5 * elastic, 0.002);  // what is left of 1 - 0.2 - 0.3
}

TEST(NeedleContact, WhatAWallLetsGoIsBoundedByWhatWasFelt) {
  NeedleBench bench = withFascia();
  // A second wall right behind the first: both give way within the first one's release.
  bench.geometry.boundaries[3].p = {0, 0, -0.0081};
  double felt = 0;
  for (double d = 0; d < 0.014; d += 2e-4) {
    const NeedleContact c = bench.atDepth(d);
    felt = std::max(felt, c.f_D.norm());
    if (c.events & kWallPunctured) {
      EXPECT_LE(unpack(bench.state.release_D).norm(), c.f_D.norm() * (1 + 1e-12));
    }
  }
  const double sum = 0.6 + 0.4 + 0.3 + 0.2;  // peaks, cutting, friction
  EXPECT_LT(felt, bench.commands.puncture_force_N + sum);
  bench.settle(0.014);
  EXPECT_LT(unpack(bench.state.release_D).norm(), 1e-6);
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

#include "haptics/modulation/taken_lumps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "haptics/modulation/touch_augmentation.h"
#include "tests/support/allocation_count.h"

namespace palpa::haptics {
namespace {

constexpr double kLumpTick = 1e-3, kTip = 0.008;

/// Silicone with a lump 14 mm below its top, whose force is the law's own.
class LumpyBlock {
 public:
  LumpyBlock() {
    law.surface.contact.real = {540, 300, 1.34};
    law.surface.contact.friction = {0.35, 1500, 0.4};
    law.surface.contact.least_contact = 0.05;
    law.tip_radius = kTip;
    law.kinds[0] = {
        0.014, {2400, 3000, 1.63}, {HuntCrossley{98, 0, 0.95}, {208, 0, 1.04}, {317, 550, 1.14}}};
    lumps[0] = {{0, 0, -0.014}, 1, 1};
  }

  /// N on the tool whose middle is at p_M; without friction.
  Vec3 reaction(const Vec3& p_M, double rate) {
    const double x = kTip - p_M.z();
    VirtualInclusion lump = law.kinds[0];
    lump.falls = 1;
    const InclusionContact contact{x > 0, Vec3(p_M - kTip * Vec3::UnitZ()), Vec3::UnitZ(), x, kTip};
    f_T = feelInclusion(lump, unpack(lumps[0].p_T0), {contact, {}}, kLumpTick, &truth_).f_T[0];
    plain = forceOf(law.surface.contact.real, x, rate) * Vec3::UnitZ();
    return plain + f_T;
  }

  /// The tool goes there in this tick.
  AugmentedTouch go(const Vec3& p_M) {
    const double rate = started_ ? (p_M_.z() - p_M.z()) / kLumpTick : 0;
    p_M_ = p_M;
    started_ = true;
    f_r = reaction(p_M, rate);
    return augmentTouch(law, lumps, {ToolTouch{true, p_M, f_r}, {}}, kLumpTick, &state);
  }
  static Vec3 at(double across, double depth) { return {across, 0, kTip - depth}; }

  TouchAugmentation law;
  PlacedLumps lumps{};
  TouchAugmentationState state;
  Vec3 f_r = Vec3::Zero(), f_T = Vec3::Zero(), plain = Vec3::Zero();

 private:
  InclusionState truth_;
  Vec3 p_M_ = Vec3::Zero();
  bool started_ = false;
};

TEST(TakenLumps, WhatIsLeftIsTheObjectAlone) {
  for (const double across : {0.0, 0.004, 0.010}) {
    LumpyBlock block;
    double off = 0, all = 0, lump = 0;
    for (int i = 0; i < 2000; ++i) {
      const double depth =
          0.0035 * (1 - std::cos(2 * std::numbers::pi * i * kLumpTick));  // two presses of 7 mm
      const AugmentedTouch now = block.go(LumpyBlock::at(across, depth));
      off += std::pow((block.f_r + now.f_d[0] - block.plain).z(), 2);
      all += std::pow(block.plain.z(), 2);
      lump += std::pow(block.f_T.z(), 2);
      if (depth > 0.003) {
        EXPECT_NEAR(now.touch[0].x, depth, 2e-4) << across;
      }
    }
    EXPECT_GT(std::sqrt(lump / all), 0.05) << across;  // there is something to take
    EXPECT_LT(std::sqrt(off / all), 0.01) << across;
  }
}

TEST(TakenLumps, AShareLeavesTheRest) {
  LumpyBlock block;
  block.lumps[0].taken = 0.5F;
  for (int i = 0; i < 500; ++i) {
    const AugmentedTouch now = block.go(LumpyBlock::at(0, 1.2e-5 * i));
    if (i < 200) continue;
    EXPECT_NEAR(now.f_d[0].z(), -0.5 * block.f_T.z(), 0.01 * block.f_r.z()) << i;
  }
}

TEST(TakenLumps, FarFromALumpNothingIsDone) {
  LumpyBlock block;
  for (int i = 0; i < 500; ++i) {
    const AugmentedTouch now = block.go(LumpyBlock::at(0.045, 1e-5 * i));
    EXPECT_LT(now.f_d[0].norm(), 1e-3) << i;
  }
}

/// Whatever the reaction: the harder it is pressed, the more is felt, and never less than nothing.
/// So however wrong the law, what stays is no spring that pushes outward.
TEST(TakenLumps, WhatStaysRisesWithWhatIsSensed) {
  for (const double strength : {0.3, 1.0, 5.0, 50.0}) {
    LumpyBlock block;
    block.law.kinds[0].H_T.k *= strength;
    TakenState state;
    double before = -1;
    for (int i = 1; i <= 300; ++i) {
      const double f = 0.01 * i;
      std::array<TouchAboveLumps, 2> tools;
      tools[0] = {true, LumpyBlock::at(0.002, 0.004), Vec3::Zero(), Vec3(0.05, 0, f)};
      state = {};  // at rest there
      const TakenLumps now = takeLumps({block.law.surface.contact, block.law.surface.contact},
                                       block.law.kinds, block.lumps, kTip, tools, 1, &state);
      const double felt = f + now.f_d[0].z();
      if (f < block.law.surface.contact.least_contact) continue;
      EXPECT_GE(felt, 0) << strength;
      EXPECT_GE(felt, before - 2e-4) << strength << " at " << f;
      before = felt;
    }
  }
}

TEST(TakenLumps, TwoToolsAreRidOfOneLump) {
  LumpyBlock block;
  VirtualInclusion lump = block.law.kinds[0];
  lump.falls = 1;
  InclusionState truth;
  for (int i = 0; i < 600; ++i) {
    const double depth = 1e-5 * i;
    std::array<InclusionContact, 2> contacts;
    std::array<ToolTouch, 2> tools;
    for (std::size_t t = 0; t < 2; ++t) {
      const Vec3 p_M = LumpyBlock::at(t == 0 ? 0.009 : -0.009, depth);
      contacts[t] = {depth > 0, Vec3(p_M - kTip * Vec3::UnitZ()), Vec3::UnitZ(), depth, kTip};
      tools[t] = {true, p_M, Vec3::Zero()};
    }
    const InclusionAnswer both =
        feelInclusion(lump, unpack(block.lumps[0].p_T0), contacts, kLumpTick, &truth);
    const double plain = forceOf(block.law.surface.contact.real, depth, i ? 0.01 : 0);
    for (std::size_t t = 0; t < 2; ++t) tools[t].f_r = plain * Vec3::UnitZ() + both.f_T[t];
    const AugmentedTouch now = augmentTouch(block.law, block.lumps, tools, kLumpTick, &block.state);
    if (i < 300) continue;
    for (std::size_t t = 0; t < 2; ++t)
      EXPECT_NEAR(tools[t].f_r.z() + now.f_d[t].z(), plain, 0.03 * plain) << i << " tool " << t;
  }
}

TEST(TakenLumps, SteepestRiseIsThatOfTheLaw) {
  const HuntCrossley stone{1e12, 0, 1};
  VirtualInclusion lump{0.015, {800, 0, 1}, {stone, stone, stone}};
  EXPECT_NEAR(steepestRise(lump, kTip, 0.006), 800, 1);
  lump.G = {HuntCrossley{400, 0, 1}, {400, 0, 1}, {400, 0, 1}};
  EXPECT_NEAR(steepestRise(lump, kTip, 0.006), 800.0 * 400 / 1200, 1);
}

TEST(TakenLumps, InvalidFiguresTakeNothingAndNothingIsAllocated) {
  LumpyBlock block;
  for (int i = 0; i < 100; ++i) block.go(LumpyBlock::at(0, 3e-5 * i));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const NoAllocation guard;
  for (const Vec3& bad : {Vec3(nan, 0, 1), Vec3(0, 0, nan), Vec3(0, 0, -1)}) {
    const AugmentedTouch now =
        augmentTouch(block.law, block.lumps, {ToolTouch{true, LumpyBlock::at(0, 0.004), bad}, {}},
                     kLumpTick, &block.state);
    EXPECT_TRUE(now.f_d[0].allFinite());
    EXPECT_EQ(now.f_d[0].z(), 0);
  }
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace palpa::haptics

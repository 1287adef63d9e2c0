#include "apps/twin/phantom/finite_block.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/error.h"
#include "tests/support/counts.h"

namespace palpa::twin {
namespace {

constexpr double kTool = 0.008;
const Fineness kCoarse{3e-3, 0.6, 15e-3}, kFine{1e-3, 0.5, 12e-3};

SoftBlock lumped() {
  SoftBlock block;
  block.lump = SoftBlock::Lump{{0, 0, -0.014}, 0.008, 24e3};
  return block;
}

/// Hertz 1882 for a rigid ball on a deep, wide, incompressible half space: f = 16/9 E sqrt(R)
/// x^1.5, E = 3 mu. The block is 25 contact radii wide; 0.1 of room for the elements, the plate and
/// the ball's own cover.
TEST(FiniteBlock, LightPressingIsHertzs) {
  const SoftBlock block;
  FiniteBlock solid(block, {0}, kTool, kFine);
  const double x = 1e-3, hertz = 16.0 / 9 * 3 * block.shear * std::sqrt(kTool) * std::pow(x, 1.5);
  EXPECT_NEAR(solid.press({Vec3(0, 0, -x)}).f[0].z(), hertz, 0.1 * hertz);
}

/// The force is what the energy costs: f = dE/dx.
TEST(FiniteBlock, ForceIsTheSlopeOfTheEnergy) {
  FiniteBlock solid(lumped(), {0.004}, kTool, kCoarse);
  const double h = 0.05e-3;
  const BlockResponse less = solid.press({Vec3(0.004, 0, -4e-3 + h)}),
                      here = solid.press({Vec3(0.004, 0, -4e-3)}),
                      more = solid.press({Vec3(0.004, 0, -4e-3 - h)});
  EXPECT_NEAR((more.energy - less.energy) / (2 * h), here.f[0].z(), 1e-3 * here.f[0].z());
  const BlockResponse left = solid.press({Vec3(0.004 - h, 0, -4e-3)}),
                      right = solid.press({Vec3(0.004 + h, 0, -4e-3)});
  EXPECT_NEAR(-(right.energy - left.energy) / (2 * h), here.f[0].x(), 1e-3 * here.f[0].norm());
}

TEST(FiniteBlock, ALumpIsFeltAndPushedAndTheWayThereDoesNotMatter) {
  FiniteBlock with(lumped(), {0.006}, kTool, kCoarse),
      without(SoftBlock{}, {0.006}, kTool, kCoarse);
  const Vec3 deep(0.006, 0, -5e-3);
  const BlockResponse felt = with.press({deep}), plain = without.press({deep});
  EXPECT_GT(felt.f[0].z(), 1.1 * plain.f[0].z());
  EXPECT_GT(felt.f[0].x(), 0);        // the tool is pushed off the lump
  EXPECT_LT(felt.lump.z(), -0.3e-3);  // and the lump down and away
  EXPECT_LT(felt.lump.x(), 0);
  with.release();
  EXPECT_NEAR(with.press({Vec3(0.006, 0, -2e-3)}).f[0].z(),
              with.press({Vec3(0.006, 0, -2e-3)}).f[0].z(), 1e-6);
  EXPECT_LT((with.press({deep}).f[0] - felt.f[0]).norm(), 1e-4 * felt.f[0].norm());
}

TEST(FiniteBlock, TwoToolsMirrorEachOther) {
  FiniteBlock solid(lumped(), {-0.012, 0.012}, kTool, kCoarse);
  const BlockResponse both = solid.press({Vec3(-0.012, 0, -4e-3), Vec3(0.012, 0, -4e-3)});
  EXPECT_NEAR(both.f[0].x(), -both.f[1].x(), 1e-3 * both.f[0].norm());
  EXPECT_NEAR(both.f[0].z(), both.f[1].z(), 1e-3 * both.f[0].norm());
  EXPECT_NEAR(both.lump.x(), 0, 1e-6);
}

/// What the shipped tables are true to: their elements against finer ones, pressed deep beside a
/// lump.
TEST(FiniteBlock, TheTablesElementsAreFineEnough) {
  if (!test::fullCounts()) GTEST_SKIP() << "finer elements take a minute: ./check --full";
  FiniteBlock tables(lumped(), {0.004}, kTool, {2.5e-3, 0.5, 12e-3}),
      finer(lumped(), {0.004}, kTool, {1.5e-3, 0.35, 8e-3});
  const Vec3 tip(0.004, 0, -6e-3);
  const Vec3 f = tables.press({tip}).f[0], f_finer = finer.press({tip}).f[0];
  EXPECT_LT((f - f_finer).norm(), 0.04 * f_finer.norm());
}

}  // namespace
}  // namespace palpa::twin

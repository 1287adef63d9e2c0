#include "apps/twin/phantom/phantom_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/error.h"
#include "apps/twin/phantom/phantom_twin.h"
#include "tests/support/counts.h"

namespace palpa::twin {
namespace {

const Fineness kRough{4e-3, 0.8, 15e-3};

SoftBlock blockWithLump() {
  SoftBlock block;
  block.lump = SoftBlock::Lump{{0, 0, -0.014}, 0.008, 24e3};
  return block;
}

/// Alone: two springs. Together: what is written into the cells.
PhantomTable springs() {
  PhantomTable one;
  one.aways = 9;
  one.depths = 4;
  one.depth_step = 2e-3;
  for (int a = 0; a < one.aways; ++a)
    for (int d = 1; d <= one.depths; ++d)
      one.cells.push_back({0, 100 * std::pow(d * one.depth_step, 1.5), 0, 0});
  return one;
}

/// More than alone at a shift, m, and depths, m: odd and even in the shift as two tools are that
/// change places.
PairCell more(double shift, double first, double second) {
  const double both = 1e6 * first * second;
  PairCell cell;
  cell.f[0] = {-both * (1 + 20 * shift), -2 * both * (1 + 100 * shift * shift)};
  cell.f[1] = {both * (1 - 20 * shift), -2 * both * (1 + 100 * shift * shift)};
  cell.lump = {0.01 * shift * first * second / 1e-4, 1e-5};
  return cell;
}

PairTable pairsOfLaw() {
  PairTable both;
  both.shifts = both.depths = 3;
  for (int s = 0; s < 3; ++s)
    for (int i = 1; i <= 3; ++i)
      for (int j = 1; j <= 3; ++j)
        both.cells.push_back(more(s * both.shift_step, i * both.depth_step, j * both.depth_step));
  return both;
}

TEST(PairTable, AddsToEachAloneWhatBothDo) {
  const PhantomTable one = springs();
  const PairTable both = pairsOfLaw();
  for (const double shift : {-0.0093, -0.004, 0.0, 0.0021, 0.01}) {
    const PairCell found = both.at(one, shift, {0.0031, 0.0055}), law = more(shift, 0.0031, 0.0055);
    for (std::size_t t = 0; t < 2; ++t) {
      const PhantomCell alone = one.at(shift + (t == 0 ? 0.01 : -0.01), t == 0 ? 0.0031 : 0.0055);
      EXPECT_NEAR(found.f[t].x(), law.f[t].x(), 1e-9) << shift;
      EXPECT_NEAR(found.f[t].y(), alone.f_up + law.f[t].y(), 1e-9) << shift;
    }
    EXPECT_NEAR(found.lump.x(), law.lump.x(), 1e-12);
  }
  EXPECT_NEAR(both.at(one, 0.003, {0.004, 0}).f[0].y(), one.at(0.013, 0.004).f_up, 1e-12);
  EXPECT_EQ(both.at(one, 0.003, {0.004, 0}).f[1].y(), 0);
}

/// The cells are what the elements say; between them it is nearly so; and the mirror image is one.
TEST(PairTable, IsWhatTheElementsSay) {
  if (!test::fullCounts()) GTEST_SKIP() << "its elements take a minute: ./check --full";
  const SoftBlock block = blockWithLump();
  PhantomTable one;
  one.aways = 6;
  one.depths = 6;
  one = tabulate(block, one, kRough);
  PairTable both;
  both.shifts = 2;
  both.depths = 3;
  both = tabulatePairs(block, one, both, kRough);
  FiniteBlock solid(block, {-0.005, 0.015}, one.tool_radius, kRough);
  const BlockResponse node = solid.press({Vec3(0.015, 0, -4e-3), Vec3(-0.005, 0, -6e-3)}),
                      between = solid.press({Vec3(0.015, 0, -5e-3), Vec3(-0.005, 0, -3e-3)});
  const PairCell at_node = both.at(one, 0.005, {4e-3, 6e-3}),
                 mirrored = both.at(one, -0.005, {6e-3, 4e-3}),
                 at_between = both.at(one, 0.005, {5e-3, 3e-3});
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_NEAR(at_node.f[t].y(), node.f[t].z(), 1e-4);
    EXPECT_NEAR(at_node.f[t].x(), node.f[t].x(), 1e-4);
    EXPECT_NEAR(mirrored.f[1 - t].x(), -at_node.f[t].x(), 1e-12);
    EXPECT_NEAR(at_between.f[t].y(), between.f[t].z(), 0.05 * between.f[t].norm());
  }
  // A neighbour takes load off and is felt: pressing together is not pressing twice.
  const double alone = one.at(0.015, 4e-3).f_up;
  EXPECT_LT(at_node.f[0].y(), 0.98 * alone);
}

TEST(PhantomPairTwin, ToolsThatAreNotSideBySideAreRefused) {
  PhantomPairTwin twin(springs(), pairsOfLaw(), {});
  EXPECT_NO_THROW(twin.step({Vec3(0.012, 0, -3e-3), Vec3(-0.008, 0, -2e-3)}, 1e-3));
  EXPECT_THROW(twin.step({Vec3(0.012, 0, -3e-3), Vec3(-0.009, 0, -2e-3)}, 1e-3), Error);
  EXPECT_THROW(twin.step({Vec3(0.012, 1e-3, -3e-3), Vec3(-0.008, 1e-3, -2e-3)}, 1e-3), Error);
}

const SiliconeLaw kElastic{.relaxes = {0, 0}};

/// What each of two fingers feels beyond what it feels alone, N, as the force on each.
std::array<Vec3, 2> beyondAlone(const std::array<Vec3, 2>& tips) {
  std::array<Vec3, 2> f;
  const auto both = PhantomFingersTwin(springs(), pairsOfLaw(), kElastic).step(tips, 1e-3);
  for (std::size_t t = 0; t < 2; ++t)
    f[t] = both[t].f - PhantomTwin(springs(), kElastic).step(tips[t], 1e-3).f;
  return f;
}

TEST(PhantomFingersTwin, SideBySideIsThePairsAndTurnedWithTheLineBetweenThem) {
  const PairCell law = more(0, 3e-3, 2e-3);
  const std::array<Vec3, 2> along_x = beyondAlone({Vec3(0.01, 0, -3e-3), Vec3(-0.01, 0, -2e-3)}),
                            along_y = beyondAlone(
                                {Vec3(0.004, 0.013, -3e-3), Vec3(0.004, -0.007, -2e-3)});
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_LT((along_x[t] - Vec3(law.f[t].x(), 0, law.f[t].y())).norm(), 1e-9);
    EXPECT_LT((along_y[t] - Vec3(0, law.f[t].x(), law.f[t].y())).norm(), 1e-9);
  }
  const std::array<Vec3, 2> far = beyondAlone({Vec3(0.02, 0, -3e-3), Vec3(-0.02, 0, -2e-3)});
  EXPECT_LT((far[0] - 0.25 * along_x[0]).norm(), 1e-9) << "twice as far, a quarter of it";
  EXPECT_LT(beyondAlone({Vec3(0.01, 0, -3e-3), Vec3(-0.01, 0, 1e-3)})[0].norm(), 1e-12)
      << "one alone";
}

/// Of a plain block, nearer and farther than the fingers of the table.
TEST(PhantomFingersTwin, IsAboutWhatTheElementsSayAtOtherDistances) {
  if (!test::fullCounts()) GTEST_SKIP() << "its elements take a minute: ./check --full";
  const SoftBlock block;
  PhantomTable one;
  one.aways = 6;
  one.depths = 6;
  one = tabulate(block, one, kRough);
  PairTable both;
  both.shifts = 1;
  both.depths = 3;
  both = tabulatePairs(block, one, both, kRough);
  for (const double apart : {0.016, 0.026}) {
    const double half = 0.5 * apart;
    FiniteBlock solid(block, {-half, half}, one.tool_radius, kRough);
    const std::array<Vec3, 2> tips{Vec3(half, 0, -5e-3), Vec3(-half, 0, -5e-3)};
    const BlockResponse told = solid.press({tips[0], tips[1]});
    const double alone = one.at(half, 5e-3).f_up, takes = alone - told.f[0].z(),
                 said = alone - PhantomFingersTwin(one, both, kElastic).step(tips, 1e-3)[0].f.z();
    EXPECT_NEAR(said, takes, 0.005 * alone) << apart << ": the neighbour takes 5 to 13 % of it";
  }
}

}  // namespace
}  // namespace palpa::twin

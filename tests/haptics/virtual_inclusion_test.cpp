#include "haptics/modulation/virtual_inclusion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/allocation_count.h"

namespace palpa::haptics {
namespace {

constexpr double kInclusionTick = 1e-3;

VirtualInclusion lumpWith(const HuntCrossley& adds, const HuntCrossley& bed) {
  return {0.015, adds, {bed, bed, bed}};
}
const Vec3 kBelow(0, 0, -0.015);  // 15 mm under a flat surface z = 0

InclusionContact pressedAt(double across, double depth) {
  return {true, {across, 0, -depth}, Vec3::UnitZ(), depth};
}

InclusionAnswer heldFor(const VirtualInclusion& lump, const std::array<InclusionContact, 2>& tools,
                        int ticks = 400, const Vec3& place = kBelow) {
  InclusionState state;
  InclusionAnswer answer;
  for (int i = 0; i < ticks; ++i)
    answer = feelInclusion(lump, place, tools, kInclusionTick, &state);
  return answer;
}

TEST(VirtualInclusion, InABedOfStoneItIsItsOwnLaw) {
  const HuntCrossley adds{900, 0, 1.2};
  for (const double depth : {0.002, 0.006, 0.010}) {
    const InclusionAnswer answer = heldFor(lumpWith(adds, {1e12, 0, 1}), {pressedAt(0, depth), {}});
    EXPECT_NEAR(answer.f_T[0].z(), adds.k * std::pow(depth, adds.m), 1e-6) << depth;
    EXPECT_NEAR(answer.f_T[0].head<2>().norm(), 0, 1e-9);
    EXPECT_LT(answer.d.norm(), 1e-9);
  }
}

/// Straight above it, with straight laws: two springs in series.
TEST(VirtualInclusion, InASoftBedItGivesWay) {
  const double k = 800, bed = 400, depth = 0.005;
  const InclusionAnswer answer =
      heldFor(lumpWith({k, 0, 1}, {bed, 0, 1}), {pressedAt(0, depth), {}});
  EXPECT_NEAR(answer.f_T[0].z(), k * bed / (k + bed) * depth, 1e-6);
  EXPECT_NEAR(answer.d.z(), -k / (k + bed) * depth, 1e-8);
}

/// Besides it, it is pushed aside and felt weakly; the bed bears what the tools feel.
TEST(VirtualInclusion, BedAndToolsBalance) {
  const HuntCrossley bed{600, 5, 1.3};
  for (const double across : {-0.02, -0.008, 0.0, 0.004, 0.015}) {
    const InclusionAnswer answer =
        heldFor(lumpWith({1500, 10, 1.4}, bed), {pressedAt(across, 0.008), {}});
    Vec3 borne;
    for (int i = 0; i < 3; ++i)
      borne[i] = (answer.d[i] < 0 ? -1 : 1) * forceOf(bed, std::abs(answer.d[i]), 0);
    EXPECT_LT((borne + answer.f_T[0]).norm(), 1e-5) << across;
    EXPECT_LT(answer.unbalanced, 1e-6);
    EXPECT_LE(answer.d.x() * across, 0) << "away from the tool";
  }
}

TEST(VirtualInclusion, BetweenTwoToolsItStaysInTheMiddle) {
  VirtualInclusion lump = lumpWith({900, 0, 1.2}, {300, 0, 1});
  lump.l0 = 0.02;
  const InclusionContact left{true, {-0.014, 0, 0}, -Vec3::UnitX(), 0.006},
      right{true, {0.014, 0, 0}, Vec3::UnitX(), 0.006};
  const InclusionAnswer answer = heldFor(lump, {left, right}, 400, Vec3::Zero());
  EXPECT_LT(answer.d.norm(), 1e-9);
  EXPECT_NEAR(answer.f_T[1].x(), 900 * std::pow(0.006, 1.2), 1e-6);
  EXPECT_LT((answer.f_T[0] + answer.f_T[1]).norm(), 1e-9);
}

/// A lump twenty times as stiff as its bed, and thick damping: a slow press is felt as a slow rise,
/// without any swinging from tick to tick.
TEST(VirtualInclusion, IsSmoothWhereAnExplicitRateWouldSwing) {
  const VirtualInclusion lump = lumpWith({8000, 200, 1.1}, {400, 600, 1.2});
  InclusionState state;
  double before = 0, slope_before = 0;
  int turns = 0, most = 0;
  for (int i = 0; i < 1500; ++i) {
    const double depth = 0.008 * std::min(1.0, i / 1000.0);
    const InclusionAnswer answer =
        feelInclusion(lump, kBelow, {pressedAt(0.003, depth), {}}, kInclusionTick, &state);
    const double f = answer.f_T[0].norm(), slope = f - before;
    turns += i > 10 && slope * slope_before < 0 && std::abs(slope - slope_before) > 1e-6;
    slope_before = slope;
    before = f;
    most = std::max(most, answer.iterations);
    EXPECT_LT(answer.unbalanced, 1e-5) << i;
  }
  EXPECT_LE(turns, 2);  // where the press ends
  EXPECT_LE(most, kMostInclusionIterations);
}

/// Stroked over, it rises toward the lump and falls behind it, alike on both sides.
TEST(VirtualInclusion, AStrokeFindsItUnderTheSurface) {
  const VirtualInclusion lump = lumpWith({1200, 0, 1.2}, {2000, 0, 1});
  double strongest = 0, at = 1;
  for (int i = -40; i <= 40; ++i) {
    const double across = 0.0005 * i;
    const double f = heldFor(lump, {pressedAt(across, 0.005), {}}, 50).f_T[0].norm();
    if (f > strongest) strongest = f, at = across;
    EXPECT_NEAR(f, heldFor(lump, {pressedAt(-across, 0.005), {}}, 50).f_T[0].norm(), 1e-9);
  }
  EXPECT_NEAR(at, 0, 1e-9);
  EXPECT_LT(heldFor(lump, {pressedAt(0.02, 0.005), {}}, 50).f_T[0].norm(), 0.6 * strongest);
}

TEST(VirtualInclusion, NothingWithoutTouchNonsenseForgotten) {
  const VirtualInclusion lump = lumpWith({900, 1, 1.2}, {300, 1, 1});
  InclusionState state;
  feelInclusion(lump, kBelow, {pressedAt(0, 0.005), {}}, kInclusionTick, &state);
  EXPECT_GT(unpack(state.d).norm(), 0);
  InclusionContact wrong = pressedAt(0, 0.005);
  wrong.p_H.y() = std::nan("");
  const NoAllocation guard;
  const InclusionAnswer from_wrong =
                            feelInclusion(lump, kBelow, {wrong, {}}, kInclusionTick, &state),
                        untouched = feelInclusion(lump, kBelow, {}, kInclusionTick, &state);
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_EQ(from_wrong.f_T[0], Vec3(Vec3::Zero()));
  EXPECT_EQ(untouched.f_T[0], Vec3(Vec3::Zero()));
  EXPECT_EQ(unpack(state.d), Vec3(Vec3::Zero()));
}

/// What a surface rubs with grows as it is pressed.
TEST(VirtualInclusion, RubsAsMuchMoreAsItPresses) {
  const Vec3 f = rubbedByLump(Vec3(0.05, 0, 0.5), Vec3(-0.3, 0.1, 0), 1.0, Vec3::UnitZ());
  EXPECT_LT((f - 0.5 * Vec3(-0.3, 0.1, 0)).norm(), 1e-12);
  EXPECT_EQ(rubbedByLump(Vec3(0, 0, 1), Vec3(1, 0, 0), 0, Vec3::UnitZ()), Vec3(Vec3::Zero()));
  EXPECT_EQ(rubbedByLump(Vec3(0, 0, NAN), Vec3(1, 0, 0), 1, Vec3::UnitZ()), Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace palpa::haptics

#include <gtest/gtest.h>

#include "apps/assess/needle/trial_review.h"
#include "tests/assess/motions.h"

namespace palpa::assess::test {
namespace {

TEST(Phase1, IsZeroOnTheTaughtPath) {
  EXPECT_NEAR(assess(textbook().samples()).values.phase_1, 0, 1e-6);
}

TEST(Phase1, AddsDistanceOfTheEntryAndDepthError) {
  Motion m;
  m.now().tip_A += Vec3(-0.003, 0, -0.004);  // 3 mm lateral, 4 mm caudal on the right side
  m.push(0.010).puncture().push(0.006).turnTo(taughtPath().direction_L).push(0.02);
  const TrialAssessment a = assess(m.samples(), "aborted");
  EXPECT_NEAR(a.values.phase_1, 5 + 2, 1e-6);
  EXPECT_EQ(penalty(a, "PHASE_1").sentence,
            "Entry 5.0 mm from the optimal point (4.0 mm too caudal, 3.0 mm too lateral); "
            "turned at a depth of 6.0 mm, 2.0 mm too shallow.");
}

TEST(Phase1, WithoutATurnTheDeepestPointBeforePhase2Counts) {
  Motion m;
  m.push(0.010).puncture().push(0.015).push(-0.005);
  EXPECT_NEAR(assess(m.samples(), "aborted").values.phase_1, 15 - 8, 1e-6);
}

TEST(Phase1, WithoutAPunctureTheLastPlaceOfTheTipCounts) {
  Motion m;
  m.push(0.006);  // stops 4 mm above the optimal entry
  EXPECT_NEAR(assess(m.samples(), "aborted").values.phase_1, 4 + 8, 1e-6);
  m.now().tip_A += Vec3(0.3, 0, 0);
  m.hold(0.1);
  EXPECT_NEAR(assess(m.samples(), "aborted").values.phase_1, 50 + 8, 1e-6);
}

Motion directed(const Vec3& axis) {
  Motion m;
  m.push(0.010).puncture().push(0.008).turnTo(axis).push(0.02);
  return m;
}

TEST(Phase2, IsAThousandAtTheEdgeOfTheAcceptableMargin) {
  for (const double off_deg : {3.0, 6.0, 12.0}) {
    const Motion m = directed(direction_L((25 + off_deg) * kDeg, 15 * kDeg));
    EXPECT_NEAR(assess(Motion(m).samples(), "aborted").values.phase_2, 1000 * off_deg / 6, 0.01);
  }
}

TEST(Phase2, NamesTheDeviationAndTheMargin) {
  const TrialAssessment steep =
      assess(directed(direction_L(33 * kDeg, 15 * kDeg)).samples(), "aborted");
  EXPECT_EQ(penalty(steep, "PHASE_2").sentence,
            "At the start of phase 2 the needle was 8° too steep: farther than experts vary (6°).");
  EXPECT_DOUBLE_EQ(penalty(steep, "PHASE_2").weight, 0.2);
  const TrialAssessment caudal =
      assess(directed(direction_L(25 * kDeg, 11 * kDeg)).samples(), "aborted");
  EXPECT_EQ(
      penalty(caudal, "PHASE_2").sentence,  // 4 degrees of azimuth are 3.6 at this elevation
      "At the start of phase 2 the needle was 4° too caudal: no farther than experts vary (6°).");
  EXPECT_EQ(penalty(caudal, "PHASE_2").points, 0);
}

TEST(Phase2, NotReachedIsJudgedByTheLastInsertionCappedAtFiveThousand) {
  Motion m;
  m.push(0.010).puncture().push(0.008).turnTo(direction_L(34 * kDeg, 15 * kDeg)).hold(1);
  EXPECT_NEAR(assess(m.samples(), "aborted").values.phase_2, 1500, 0.01);
  Motion straight;
  straight.push(0.010).puncture().push(0.008);  // about 65 degrees off: more than 10000
  EXPECT_EQ(assess(straight.samples(), "aborted").values.phase_2, 5000);
  Motion never;
  never.push(0.005);
  EXPECT_EQ(assess(never.samples(), "aborted").values.phase_2, 5000);
}

TEST(Economy, IsZeroAlongTheTaughtLine) {
  const ParacentesisValues v = assess(textbook().samples()).values;
  EXPECT_NEAR(v.econ_mean, 0, 1e-6);
  EXPECT_NEAR(v.econ_var, 0, 1e-9);
}

TEST(Economy, ParallelOffsetIsItsMeanWithoutVariance) {
  Motion m;
  const Vec3 across = taughtPath().direction_L.cross(Vec3::UnitY()).normalized();
  m.now().tip_A += 0.004 * across;
  m.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.02);
  const ParacentesisValues v = assess(m.samples(), "aborted").values;
  EXPECT_NEAR(v.econ_mean, 4, 1e-6);
  EXPECT_NEAR(v.econ_var, 0, 1e-9);
}

TEST(Economy, ShaftTiltedAboutTheTipCountsHalfItsDistance) {
  // Phase 2 begins on the line; then the tip stays and the shaft turns by 10 degrees at once, half
  // of phase 2's samples each: e is 0 and 70 sin(10 deg) / 2.
  Motion m = directed(taughtPath().direction_L);
  const Pass pass = detectPhases(m.samples()).passes[0];
  const std::size_t before = pass.last - pass.phase_2 + 1;
  m.now().axis_A = Eigen::AngleAxisd(10 * kDeg, taughtPath().direction_L.unitOrthogonal()) *
                   taughtPath().direction_L;
  m.hold(static_cast<double>(before) / 1000);
  const double e = 70 * std::sin(10 * kDeg) / 2;
  const ParacentesisValues v = assess(m.samples(), "aborted").values;
  EXPECT_NEAR(v.econ_mean, e / 2, 1e-6);
  EXPECT_NEAR(v.econ_var, e * e / 4, 1e-6);
}

TEST(Economy, IsZeroAndSaidSoWithoutPhase2) {
  Motion m;
  m.push(0.010).puncture().push(0.008);
  const TrialAssessment a = assess(m.samples(), "aborted");
  EXPECT_EQ(a.values.econ_mean, 0);
  EXPECT_EQ(penalty(a, "ECON_MEAN").sentence, "Phase 2 was not reached.");
}

TEST(Redirections, CountReversalsWithAChangedDirectionOnly) {
  const auto after = [](auto more) {
    Motion m = directed(taughtPath().direction_L);
    more(m);
    return assess(m.samples(), "aborted").redirections;
  };
  const Vec3 other = direction_L(20 * kDeg, 15 * kDeg);
  EXPECT_EQ(after([](Motion&) {}), 0);
  EXPECT_EQ(after([&](Motion& m) { m.push(-0.005).turnTo(other).push(0.006); }), 1);
  EXPECT_EQ(after([](Motion& m) { m.push(-0.005).push(0.006); }), 0);  // same direction
  EXPECT_EQ(after([&](Motion& m) { m.push(-0.002).turnTo(other).push(0.006); }), 0);  // 2 mm only
  EXPECT_EQ(after([&](Motion& m) {
              m.push(-0.005).turnTo(other).push(0.006);
              m.push(-0.005).turnTo(taughtPath().direction_L).push(0.006);
            }),
            2);
}

TEST(Sides, MirroredPatientAndMotionScoreTheSame) {
  anatomy::Patient left = landmarksOnly();
  left.side = anatomy::Side::left;
  for (auto& [name, p] : left.landmarks) p.x() = -p.x();
  Motion m;
  m.now().tip_A += Vec3(-0.003, 0, -0.004);
  m.push(0.010).puncture().push(0.006).turnTo(direction_L(31 * kDeg, 11 * kDeg)).push(0.02);
  std::vector<TrialSample> mirrored = m.samples();
  for (TrialSample& s : mirrored) s.tip_A.x() = -s.tip_A.x(), s.axis_A.x() = -s.axis_A.x();
  const TrialAssessment a = assess(m.samples(), "aborted");
  const TrialAssessment b = assessTrial(facts("aborted"), mirrored, left, OrganDistance(far),
                                        taughtPath(), ScoringRules{});
  EXPECT_EQ(a.total, b.total);
  for (std::size_t i = 0; i < a.penalties.size(); ++i)
    EXPECT_EQ(a.penalties[i].sentence, b.penalties[i].sentence);
}

}  // namespace
}  // namespace palpa::assess::test

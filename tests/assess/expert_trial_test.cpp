#include <gtest/gtest.h>

#include "tests/assess/motions.h"

namespace palpa::assess::test {
namespace {

const anatomy::LandmarkFrame& frame() {
  static const anatomy::LandmarkFrame f(landmarksOnly());
  return f;
}

TEST(ExpertTrial, ReadsEntryDepthDirectionAndPath) {
  calibration::ExpertTrial trial;
  ASSERT_TRUE(expertTrial(textbook().samples(), frame(), teachingLine(), "A", &trial));
  const calibration::TaughtPath taught = taughtPath();
  EXPECT_EQ(trial.expert, "A");
  EXPECT_LT((trial.entry_L - taught.entry_L).norm(), 1e-9);
  EXPECT_NEAR(trial.depth, taught.depth, 1e-9);
  EXPECT_LT((trial.direction_L - taught.direction_L).norm(), 1e-9);
  const Vec3 advanced = trial.start_L - taught.line_from_L;  // up to 3 mm until it counts
  EXPECT_LT(advanced.cross(taught.direction_L).norm(), 1e-9);
  EXPECT_LT(advanced.norm(), 0.003);
  EXPECT_EQ(trial.line.target_L, teachingLine().target_L);
  EXPECT_LT((trial.end_L - taught.line_to_L).norm(), 1e-9);
}

TEST(ExpertTrial, NeedsATurnAnAdvanceAndTheVein) {
  calibration::ExpertTrial trial;
  EXPECT_FALSE(expertTrial({}, frame(), teachingLine(), "A", &trial));
  Motion shallow;
  shallow.push(0.010).puncture().push(0.008);
  EXPECT_FALSE(expertTrial(shallow.samples(), frame(), teachingLine(), "A", &trial));
  Motion missed;
  missed.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.03);
  EXPECT_FALSE(expertTrial(missed.samples(), frame(), teachingLine(), "A", &trial));
  Motion straight;
  straight.push(0.010).puncture().push(0.02).in(Tissue::vein_lumen).hold(1);
  EXPECT_FALSE(expertTrial(straight.samples(), frame(), teachingLine(), "A", &trial));
}

TEST(ExpertTrial, TheirOwnTrialsScoreNearlyNothingOnTheirPath) {
  std::vector<calibration::ExpertTrial> trials;
  for (int i = 0; i < 30; ++i) {  // entries on a 5 x 6 grid of 1 mm
    Motion m;
    m.now().tip_A += Vec3(0.001 * (i % 5 - 2), 0, 0.001 * (i / 5 - 2.5));
    m.push(0.010).puncture().push(0.008).turnTo(taughtPath().direction_L).push(0.028);
    m.in(Tissue::vein_lumen).push(0.002);
    calibration::ExpertTrial trial;
    ASSERT_TRUE(expertTrial(m.samples(), frame(), teachingLine(), "A", &trial));
    trials.push_back(trial);
  }
  const calibration::ExpertPath experts = calibration::fitExpertPath(trials);
  EXPECT_EQ(experts.left_out, 0);
  const calibration::TaughtPath path = experts.onBody(teachingLine());
  EXPECT_LT((path.entry_L - taughtPath().entry_L).norm(), 1e-9);
  const TrialAssessment a = assessTrial(facts(), textbook().samples(), landmarksOnly(),
                                        OrganDistance(nowhere), path, ScoringRules{});
  EXPECT_NEAR(a.total - 0.01 * a.values.time_ms, 0, 1e-3);
}

}  // namespace
}  // namespace palpa::assess::test

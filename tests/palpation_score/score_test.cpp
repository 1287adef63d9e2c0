#include <gtest/gtest.h>

#include "apps/assess/palpation/palpation_score.h"
#include "searches.h"

namespace palpa::assess {
namespace {

CaseLump lumpAt(double x, double y) { return {Vec3(x, y, -0.014), 0.016, 2, 1}; }
LumpMark markAt(double x, double y) { return {10, Vec3(x, y, -0.004), 0.020, 2, 2}; }

TEST(PalpationScore, MarksFindWhatIsNear) {
  const PalpationScore score = scorePalpation({}, {lumpAt(0.02, 0.02), lumpAt(-0.02, -0.02)}, {},
                                              {markAt(0.02, 0.012), markAt(-0.02, -0.0351)});
  EXPECT_EQ(score.found, 1);
  EXPECT_EQ(score.missed, 1);
  EXPECT_EQ(score.false_alarms, 1);
  EXPECT_EQ(score.lumps[0].mark, 0);
  EXPECT_NEAR(score.lumps[0].error, 0.008, 1e-12);
  EXPECT_NEAR(score.lumps[0].size_error, 0.004, 1e-12);
  EXPECT_TRUE(score.lumps[0].hardness_right);
  EXPECT_FALSE(score.lumps[0].mobility_right);
  EXPECT_EQ(score.lumps[1].mark, -1);
  EXPECT_EQ(score.sensitivity(), 0.5);
}

/// A second finger that presses beside the first, in the same time.
TEST(PalpationScore, TwoFingersFeelTwiceTheAreaInTheSameTime) {
  const Search first = inStrips(0.012, 0.006, 0.7);
  std::vector<PalpationSample> both;
  for (const PalpationSample& sample : first.samples()) {
    both.push_back(sample);
    both.push_back({sample.t_s, sample.p_P + Vec3(0.018, 0, 0), 2 * sample.f_n, 1});
  }
  PalpationRules rules;
  rules.levels = {0.15, 0.3, 0.6};
  const PalpationScore one = scorePalpation(rules, {}, first.samples(), {}),
                       two = scorePalpation(rules, {}, both, {});
  EXPECT_EQ(two.seconds, one.seconds);
  EXPECT_EQ(two.presses, 2 * one.presses);
  EXPECT_GT(two.coverage[0], 1.4 * one.coverage[0]) << "what both feel lies over each other";
  EXPECT_NEAR(two.peak, 2 * one.peak, 1e-12);
  EXPECT_NEAR(two.mean, 1.5 * one.mean, 0.05 * one.mean) << "over both fingers' time";
  EXPECT_EQ(two.pattern.pattern, one.pattern.pattern) << "a finger beside the first is no pattern";
}

TEST(PalpationScore, NormalAnatomyThatIsMarkedIsAFalseAlarmOfItsOwn) {
  PalpationRules rules;
  rules.normal = {{"a rib", {Vec3(-0.02, 0.01, 0), Vec3(0.02, 0.01, 0)}, 0.01}};
  const PalpationScore score =
      scorePalpation(rules, {lumpAt(0.01, -0.02)}, {},
                     {markAt(0.005, 0.0199), markAt(0.005, 0.0215), markAt(0.01, -0.02)});
  EXPECT_EQ(score.found, 1);
  EXPECT_EQ(score.false_alarms, 2);
  EXPECT_EQ(score.of_normal, 1);
  EXPECT_NEAR(fromLine(rules.normal[0], Vec3(0.023, 0.014, 0)), 0.005, 1e-12);
}

/// Two marks between two lumps: each lump gets the mark that leaves the other its own.
TEST(PalpationScore, EveryLumpGetsOneMarkAndAMarkOneLump) {
  const PalpationScore both = scorePalpation({}, {lumpAt(0, 0), lumpAt(0.012, 0)}, {},
                                             {markAt(0.001, 0), markAt(0.010, 0)});
  EXPECT_EQ(both.found, 2);
  EXPECT_EQ(both.lumps[0].mark, 0);
  EXPECT_EQ(both.lumps[1].mark, 1);
  const PalpationScore twice =
      scorePalpation({}, {lumpAt(0, 0)}, {}, {markAt(0.001, 0), markAt(0.010, 0)});
  EXPECT_EQ(twice.found, 1);
  EXPECT_EQ(twice.repeated, 1);
  EXPECT_EQ(twice.false_alarms, 0);
}

TEST(PalpationScore, QuartersWithoutALumpCanBeClear) {
  const PalpationScore empty = scorePalpation({}, {}, {}, {});
  EXPECT_EQ(empty.clear_quadrants, 4);
  EXPECT_EQ(empty.specificity(), 1);
  EXPECT_EQ(empty.sensitivity(), 1);  // nothing to find
  const PalpationScore alarmed =
      scorePalpation({}, {lumpAt(0.025, 0.025)}, {},
                     {markAt(-0.02, -0.02), markAt(-0.01, -0.03), markAt(0.025, 0.025)});
  EXPECT_EQ(alarmed.clear_quadrants, 3);
  EXPECT_EQ(alarmed.wrong_quadrants, 1);
  EXPECT_NEAR(alarmed.specificity(), 2.0 / 3, 1e-12);
  EXPECT_EQ(alarmed.ill_quadrants, 1);
  EXPECT_EQ(alarmed.hit_quadrants, 1);
  const PalpationScore missed = scorePalpation({}, {lumpAt(0.025, 0.025)}, {}, {});
  EXPECT_EQ(missed.ill_quadrants, 1);
  EXPECT_EQ(missed.hit_quadrants, 0);
  EXPECT_EQ(scorePalpation({}, {lumpAt(0, 0)}, {}, {}).clear_quadrants,
            0);  // in the middle it is near all
}

TEST(PalpationScore, ForcesAndTime) {
  Search search = inStrips(0.034, 0.0085, 1.0);
  for (int i = 0; i < 5; ++i) search.press(0.01, 0.01, 1.2);
  search.press(0.0, 0.0, 3.0);
  const PalpationScore score = scorePalpation({}, {}, search.samples(), {});
  EXPECT_NEAR(score.peak, 3, 1e-9);
  EXPECT_GT(score.too_hard, 0);
  EXPECT_LT(score.too_hard, 0.02);
  EXPECT_GT(score.too_light, 0.1);  // every press begins and ends lightly
  EXPECT_NEAR(score.closer_force, 1.2, 0.05);
  EXPECT_EQ(score.coverage[1], 1);
  EXPECT_NEAR(score.seconds, search.now(), 0.02);
  EXPECT_EQ(score.pattern.pattern, SearchPattern::strips);
}

}  // namespace
}  // namespace palpa::assess

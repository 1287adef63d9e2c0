#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "anatomy/base/random.h"
#include "apps/assess/progress/learning_curve.h"
#include "tests/support/counts.h"

namespace palpa::progress {
namespace {

std::vector<double> exponential(double a, double b, double c, int n) {
  std::vector<double> y;
  for (int i = 0; i < n; ++i) y.push_back(a + b * std::exp(-i / c));
  return y;
}

TEST(LearningCurve, AnExactCurveIsRecovered) {
  const std::vector<double> y = exponential(300, 900, 4, 25);
  const auto curve = learningCurve(y);
  ASSERT_TRUE(curve);
  // The grid of time constants is a ratio of 1.042 apart: c is met to half of that.
  EXPECT_NEAR(curve->constant, 4, 0.09);
  EXPECT_NEAR(curve->asymptote, 300, 5);
  EXPECT_NEAR(curve->gain, 900, 12);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(curve->fitted[i], y[i], 6);
  EXPECT_TRUE(curve->changed());
  EXPECT_NEAR(curve->change, y.back() - y.front(), 10);
}

TEST(LearningCurve, TheBandHoldsTheTrueCurveMostOfTheTime) {
  const int studies = palpa::test::counted(60, 400);
  int inside = 0, points = 0;
  for (int s = 0; s < studies; ++s) {
    RandomStream random = RandomStream::ofSeed(static_cast<std::uint64_t>(s) + 1);
    const std::vector<double> truth = exponential(10, 8, 5, 20);
    std::vector<double> y = truth;
    for (double& v : y) v += 1.5 * random.openNormal();
    const auto curve = learningCurve(y, static_cast<std::uint64_t>(s));
    ASSERT_TRUE(curve);
    for (std::size_t i = 0; i < y.size(); ++i, ++points)
      inside += curve->low[i] <= truth[i] && truth[i] <= curve->high[i];
  }
  // Nominal 0.95; points of one study go together, so that 60 studies say it to about +-0.05.
  // Residual bootstraps of three parameters fall short a little.
  EXPECT_GT(static_cast<double>(inside) / points, 0.86);
  EXPECT_LT(static_cast<double>(inside) / points, 0.995);
}

TEST(LearningCurve, NoiseIsNoLearning) {
  const int studies = palpa::test::counted(60, 400);
  int found = 0;
  for (int s = 0; s < studies; ++s) {
    RandomStream random = RandomStream::ofSeed(1000 + static_cast<std::uint64_t>(s));
    std::vector<double> y;
    for (int i = 0; i < 15; ++i) y.push_back(100 + 10 * random.openNormal());
    found += learningCurve(y, static_cast<std::uint64_t>(s))->changed();
  }
  // Nominal 0.05; as the curve bends freely at its ends, up to a fifth.
  EXPECT_LT(found, studies / 5);
}

TEST(LearningCurve, TooFewOrConstantValuesHaveNone) {
  EXPECT_FALSE(learningCurve(exponential(1, 2, 3, 7)));
  EXPECT_FALSE(learningCurve(std::vector<double>(20, 5.0)));
  std::vector<double> gaps = exponential(1, 2, 3, 12);
  for (int i = 0; i < 5; ++i)
    gaps[2 * static_cast<std::size_t>(i)] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(learningCurve(gaps));  // seven are left
  gaps[0] = 3;
  const auto curve = learningCurve(gaps);
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->trials.size(), 8u);
  EXPECT_EQ(curve->fitted.size(), 12u);
}

TEST(LearningCurve, TheSameSeedGivesTheSameBand) {
  std::vector<double> y = exponential(5, 4, 6, 12);
  y[3] += 1;
  y[8] -= 1;
  EXPECT_EQ(learningCurve(y, 3)->low, learningCurve(y, 3)->low);
  EXPECT_NE(learningCurve(y, 3)->low, learningCurve(y, 4)->low);
}

TEST(Change, ItsDirectionIsTheMetrics) {
  const std::vector<double> falling{10, 11, 10, 9, 8, 7, 5, 4, 4.5, 4};
  const auto time = changeOf("time_s", falling), sensitivity = changeOf("sensitivity_pct", falling);
  ASSERT_TRUE(time && sensitivity);
  EXPECT_EQ(time->each, 3u);
  EXPECT_NEAR(time->first, 31.0 / 3, 1e-12);
  EXPECT_NEAR(time->last, 12.5 / 3, 1e-12);
  EXPECT_NEAR(time->difference, time->last - time->first, 1e-12);
  EXPECT_EQ(time->verdict, Change::ChangeVerdict::better);
  EXPECT_EQ(sensitivity->verdict, Change::ChangeVerdict::worse);
  EXPECT_EQ(changeOf("time_s", {5, 9, 1, 4, 8, 2, 6, 3, 9})->verdict,
            Change::ChangeVerdict::unclear);
}

TEST(Change, WithoutADirectionOrTrialsThereIsNone) {
  EXPECT_FALSE(changeOf("mean_speed_mm_s", {1, 2, 3, 4, 5, 6, 7}));
  EXPECT_FALSE(changeOf("time_s", {1, 2, 3, 4, 5}));
  EXPECT_FALSE(changeOf("no such figure", {1, 2, 3, 4, 5, 6, 7}));
}

TEST(SuccessBlocks, WhatIsLeftOverJoinsTheLast) {
  std::vector<bool> s(12, true);
  s[0] = s[1] = s[11] = false;
  const auto blocks = successBlocks(s);
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_EQ(blocks[0].hits, 3);
  EXPECT_EQ(blocks[0].of, 5);
  EXPECT_EQ(blocks[1].from, 6u);
  EXPECT_EQ(blocks[1].to, 12u);
  EXPECT_EQ(blocks[1].hits, 6);
  EXPECT_TRUE(successBlocks({}).empty());
}

}  // namespace
}  // namespace palpa::progress

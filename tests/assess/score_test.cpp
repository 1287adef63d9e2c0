#include "apps/assess/needle/paracentesis_score.h"

#include <gtest/gtest.h>

namespace palpa::assess {
namespace {

ParacentesisValues row(double lung, double rib, double artery, double vein, double phase_1,
                       double phase_2, double mean, double variance, double time_ms) {
  return {lung, rib, artery, vein, phase_1, phase_2, mean, variance, time_ms, true};
}

TEST(Score, ThePapersSampleRowsGiveItsTotals) {
  // Exact sums; 1e-9 covers the rounding of 0.01.
  EXPECT_NEAR(total(row(0, 0, 0, 1, 6, 0, 18, 27, 31524)), 913.24, 1e-9);
  EXPECT_NEAR(total(row(0, 25, 0, 9, 4, 982, 12, 51, 157840)), 3970.40, 1e-9);
}

TEST(Score, Phase2WeighsInThreeMargins) {
  EXPECT_EQ(total(row(0, 0, 0, 0, 0, 999, 0, 0, 0)), 0);
  EXPECT_DOUBLE_EQ(total(row(0, 0, 0, 0, 0, 1000, 0, 0, 0)), 200);
  EXPECT_DOUBLE_EQ(total(row(0, 0, 0, 0, 0, 1999, 0, 0, 0)), 0.2 * 1999);
  EXPECT_DOUBLE_EQ(total(row(0, 0, 0, 0, 0, 2000, 0, 0, 0)), 800);
}

TEST(Score, EachValueAddsItsWeight) {
  const double weights[] = {500, 50, 50, 10, 2};
  for (int i = 0; i < 5; ++i) {
    double v[5] = {};
    v[i] = 1;
    EXPECT_DOUBLE_EQ(total(row(v[0], v[1], v[2], v[3], v[4], 0, 0, 0, 0)), weights[i]);
  }
  EXPECT_DOUBLE_EQ(total(row(0, 0, 0, 0, 0, 0, 1, 0, 0)), 2);
  EXPECT_DOUBLE_EQ(total(row(0, 0, 0, 0, 0, 0, 0, 1, 0)), 20);
  EXPECT_DOUBLE_EQ(total(row(0, 0, 0, 0, 0, 0, 0, 0, 100)), 1);
}

TEST(Phase2Weight, ContinuousHasNoJumpAndMeetsThePrintedOne) {
  ScoreWeights w;
  w.phase_2 = Phase2Weight::continuous;
  const ScoreWeights printed;
  double before = 0;
  for (double value = 0; value <= 4000; value += 0.5) {
    const double points = w.phase2Weight(value) * value;
    EXPECT_GE(points, before) << value;
    EXPECT_LT(points - before, 1) << "a jump at " << value;
    before = points;
  }
  for (const double value : {0.0, 999.0, 1500.0, 2000.0, 5000.0})
    EXPECT_DOUBLE_EQ(w.phase2Weight(value), printed.phase2Weight(value)) << value;
}

}  // namespace
}  // namespace palpa::assess

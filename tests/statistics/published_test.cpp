// The figures of the two studies that Palpa's analyses follow, recomputed from what was printed. A
// printed figure that lacks digits is noted beside; the expected one is what the printed means,
// standard deviations and counts give.
#include <gtest/gtest.h>

#include "apps/assess/statistics/tests_of_means.h"

namespace palpa::statistics {
namespace {

// Tzafestas, Birbas, Koumpouros, Christopoulos 2008, tables 3 and 4: novices, trials 9-10 against
// trials 1-2, five users and two trials taken as ten independent values; one-tailed.
struct Cell {
  Moments last, first;
  double p_welch, p_pooled, learning_percent;
};

const Cell kWithoutForceTime{
    {55.2, 42.3, 10}, {71.5, 27.1, 10}, 0.1604, 0.1592, 22.8};  // printed .162
const Cell kWithoutForceScore{
    {1223.76, 767.60, 10}, {1918.99, 1163.55, 10}, 0.0674, 0.0661, 36.2};  // no p printed
const Cell kWithForceTime{
    {46.3, 28.3, 10}, {89.9, 41.4, 10}, 0.0072, 0.0066, 48.5};  // printed .007; 48.42 %
const Cell kWithForceScore{{859.32, 346.26, 10},
                           {1636.37, 1447.34, 10},
                           0.0648,
                           0.0580,
                           47.5};  // printed .065: only Welch's

class PublishedCell : public testing::TestWithParam<Cell> {};

TEST_P(PublishedCell, OfLearning) {
  const Cell& cell = GetParam();
  EXPECT_NEAR(welchFromMoments(cell.last, cell.first).p_less, cell.p_welch, 5e-5);
  EXPECT_NEAR(pooledFromMoments(cell.last, cell.first).p_less, cell.p_pooled, 5e-5);
  EXPECT_NEAR(100 * (1 - cell.last.mean / cell.first.mean), cell.learning_percent, 0.05);
}
INSTANTIATE_TEST_SUITE_P(Tzafestas2008, PublishedCell,
                         testing::Values(kWithoutForceTime, kWithoutForceScore, kWithForceTime,
                                         kWithForceScore));

TEST(Published, TheScoreWithForceTellsWelchFromPooled) {
  EXPECT_NEAR(welchFromMoments(kWithForceScore.last, kWithForceScore.first).p_less, 0.065, 0.0005);
  EXPECT_GT(std::abs(pooledFromMoments(kWithForceScore.last, kWithForceScore.first).p_less - 0.065),
            0.005);
}

// Edmunds and Pai, the four analyses of variance of 21 subjects in two groups.
TEST(Published, AnovasOfTheSearchStudy) {
  EXPECT_NEAR(fTail(1.41, 1, 19), 0.250, 0.0005);
  EXPECT_NEAR(fTail(0.03, 1, 19), 0.864, 0.0005);  // printed .87
  EXPECT_NEAR(fTail(3.14, 1, 19), 0.092, 0.0005);
  EXPECT_NEAR(fTail(5.80, 1, 19), 0.026, 0.0005);
}

}  // namespace
}  // namespace palpa::statistics

#include "anatomy/base/quantile.h"
#include "apps/bench/timing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/random.h"

namespace palpa::bench {
namespace {

TEST(AbbaOrder, ASteadyDriftAddsTheSameToBothInEveryBlock) {
  const std::vector<Turn> order = abbaOrder(10);
  ASSERT_EQ(order.size(), 40u);
  for (std::size_t block = 0; block < 10; ++block) {
    std::size_t places_a = 0, places_b = 0;
    for (std::size_t i = 4 * block; i < 4 * block + 4; ++i)
      (order[i] == Turn::a ? places_a : places_b) += i;
    EXPECT_EQ(places_a, places_b) << block;
    EXPECT_EQ(order[4 * block], Turn::a);
  }
  EXPECT_TRUE(abbaOrder(0).empty());
}

TEST(Median, IsTheMiddleOrTheMeanOfTheTwoThere) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(median({5}), 5);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(BootstrapMedian, OfEqualValuesIsThatValue) {
  const ConfidenceInterval i = bootstrapMedian(std::vector<double>(10, 1.25), 2000, 1);
  EXPECT_EQ(i.low, 1.25);
  EXPECT_EQ(i.high, 1.25);
}

TEST(BootstrapMedian, OfTwoValuesHasTheKnownQuantiles) {
  // Draws of {0, 1}: both 0 with 1/4, both 1 with 1/4, else 0.5. So the 2.5 % quantile is 0,
  // the 97.5 % one 1.
  const ConfidenceInterval two = bootstrapMedian({0, 1}, 2000, 3);
  EXPECT_EQ(two.low, 0);
  EXPECT_EQ(two.high, 1);
  // Of one 1 among nine 0 the median of a draw is 1 with P(Bin(9, 1/9) >= 5) = 0.0013: outside the
  // interval.
  const ConfidenceInterval nine = bootstrapMedian({0, 0, 0, 0, 1, 0, 0, 0, 0}, 2000, 3);
  EXPECT_EQ(nine.low, 0);
  EXPECT_EQ(nine.high, 0);
}

TEST(BootstrapMedian, SameSeedSameIntervalAndNothingGivesNothing) {
  const std::vector<double> values{0.9, 1.1, 1.3, 0.7, 1.0, 1.2, 0.8, 1.05, 0.95, 1.15};
  const ConfidenceInterval a = bootstrapMedian(values, 2000, 5),
                           b = bootstrapMedian(values, 2000, 5);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  EXPECT_LT(a.low, median(values));
  EXPECT_GT(a.high, median(values));
  EXPECT_TRUE(std::isnan(bootstrapMedian({}, 2000, 5).low));
}

/// The percentile bootstrap of a median of 10 stands, by the order statistics of the binomial, for
/// about 0.95 to 0.98 coverage; 400 trials know a share of 0.95 to +-0.033 at three standard
/// deviations.
TEST(BootstrapMedian, HoldsTheTrueMedianAboutAsOftenAsItSays) {
  RandomStream random(11, "coverage");
  int inside = 0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> values(10);
    for (double& v : values) v = random.normal(1, 0.2);
    const ConfidenceInterval i = bootstrapMedian(values, 400, static_cast<std::uint64_t>(trial));
    inside += i.low <= 1 && 1 <= i.high;
  }
  EXPECT_GT(inside, 0.917 * kTrials);
  EXPECT_LT(inside, kTrials) << "an interval that always holds it says nothing";
}

}  // namespace
}  // namespace palpa::bench

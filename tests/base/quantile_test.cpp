#include "anatomy/base/quantile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace palpa {
namespace {

TEST(Quantile, IsTheNearestRankWhateverTheOrder) {
  std::vector<double> values(100);
  std::iota(values.rbegin(), values.rend(), 1.0);
  EXPECT_EQ(quantile(values, 0.5), 50);
  EXPECT_EQ(quantile(values, 0.99), 99);
  EXPECT_EQ(quantile(values, 0.991), 100);
  EXPECT_EQ(quantile(values, 1), 100);
  EXPECT_EQ(quantile(values, 0), 1);
  EXPECT_EQ(quantile({7}, 0.01), 7);
  EXPECT_EQ(quantile({}, 0.5), 0);
}

TEST(Median, OfAnEvenCountIsTheMeanOrTheUpperOfTheMiddleTwo) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(median({5}), 5);
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_EQ(upperMedian({3, 1, 2}), 2);
  EXPECT_EQ(upperMedian({4, 1, 3, 2}), 3);
  EXPECT_EQ(upperMedian({}), 0);
}

}  // namespace
}  // namespace palpa

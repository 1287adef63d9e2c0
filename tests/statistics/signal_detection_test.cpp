#include <gtest/gtest.h>

#include <cmath>

#include "apps/assess/statistics/sample.h"

namespace palpa::statistics {
namespace {

/// 84.13 % of a normal distribution lie below one standard deviation above its mean.
TEST(SignalDetection, OneStandardDeviationEitherWay) {
  const Discrimination told = discriminationOf({8413, 10000, 1586, 10000});
  EXPECT_NEAR(told.d, 2, 1e-3);
  EXPECT_NEAR(told.criterion, 0, 1e-3);
}

TEST(SignalDetection, CallingEverythingTellsNothing) {
  const Discrimination all = discriminationOf({10, 10, 10, 10}),
                       none = discriminationOf({0, 10, 0, 10});
  EXPECT_NEAR(all.d, 0, 1e-12);
  EXPECT_NEAR(none.d, 0, 1e-12);
  EXPECT_LT(all.criterion, -1);
  EXPECT_NEAR(none.criterion, -all.criterion, 1e-12);
}

/// z(10.5/11) = -z(0.5/11) = 1.6906.
TEST(SignalDetection, StaysFiniteWhereNothingWasWrong) {
  const Discrimination told = discriminationOf({10, 10, 0, 10});
  EXPECT_NEAR(told.d, 2 * 1.6906, 1e-3);
  EXPECT_NEAR(told.criterion, 0, 1e-12);
}

TEST(SignalDetection, NeedsBothKinds) {
  EXPECT_TRUE(std::isnan(discriminationOf({0, 0, 0, 10}).d));
  EXPECT_TRUE(std::isnan(discriminationOf({5, 10, 0, 0}).criterion));
}

}  // namespace
}  // namespace palpa::statistics

#include "apps/training/fading_support.h"

#include <gtest/gtest.h>

namespace palpa::training {
namespace {

TEST(FadingSupport, EverySecondTrialHasNoneAndGoodOnesMakeItLess) {
  FadingSupport support(true);
  EXPECT_EQ(support.in(1), 1);
  EXPECT_EQ(support.in(2), 0);
  support.end(true);
  EXPECT_NEAR(support.in(3), 0.66, 1e-12);
  support.end(false);
  EXPECT_NEAR(support.in(3), 0.83, 1e-12);
  for (int i = 0; i < 3; ++i) support.end(true);
  EXPECT_EQ(support.in(5), 0);
  EXPECT_FALSE(support.helps(5));
  support.end(false);
  EXPECT_NEAR(support.in(7), 0.17, 1e-12);
  for (int i = 0; i < 20; ++i) support.end(false);
  EXPECT_EQ(support.in(9), 1);
}

TEST(FadingSupport, OffItIsNothingAndAStartIsBounded) {
  FadingSupport off(false);
  off.end(false);
  EXPECT_EQ(off.in(1), 0);
  EXPECT_NEAR(FadingSupport(true, 0.4).in(1), 0.4, 1e-12);
  EXPECT_EQ(FadingSupport(true, 7).in(1), 1);
  EXPECT_EQ(FadingSupport(true, -7).in(1), 0);
}

}  // namespace
}  // namespace palpa::training

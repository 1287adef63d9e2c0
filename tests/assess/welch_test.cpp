#include "apps/assess/welch.h"

#include <gtest/gtest.h>

#include "anatomy/geometry/error.h"

namespace palpa::assess {
namespace {

// Tzafestas et al. 2008, tables 3 and 4: n = 10 a cell, one-tailed. Expected values are recomputed from the
// printed means and standard deviations.
TEST(Welch, PublishedTableThreeTime) {
  EXPECT_NEAR(welchFromMoments(55.2, 42.3, 10, 71.5, 27.1, 10).p_less, 0.160, 0.0005);
}

TEST(Welch, DirectionAndTails) {
  const WelchTest test = welch({1, 2, 3, 4}, {5, 6, 7, 9});
  EXPECT_LT(test.t, 0);
  EXPECT_NEAR(test.p_two_sided, 2 * test.p_less, 1e-12);
  EXPECT_NEAR(welch({5, 6, 7, 9}, {1, 2, 3, 4}).p_less, 1 - test.p_less, 1e-12);
}

TEST(Welch, RefusesWhatCannotBeTested) {
  EXPECT_THROW(welch({1}, {1, 2}), Error);
  EXPECT_THROW(welch({1, 1}, {2, 2}), Error);
}

}  // namespace
}  // namespace palpa::assess

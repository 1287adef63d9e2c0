// Against published examples: data and results as printed in the sources named.
#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/error.h"
#include "apps/assess/statistics/assumptions.h"
#include "apps/assess/statistics/sample.h"
#include "apps/assess/statistics/tests_of_means.h"

namespace palpa::statistics {
namespace {

// Student 1908: extra hours of sleep of ten patients under two drugs.
const std::vector<double> kDrug1{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
const std::vector<double> kDrug2{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

TEST(TTests, StudentsSleep) {
  const TTest w = welch(kDrug1, kDrug2), p = pooled(kDrug1, kDrug2), pairs = paired(kDrug1, kDrug2);
  EXPECT_NEAR(w.t, -1.8608, 5e-5);
  EXPECT_NEAR(w.degrees, 17.776, 5e-4);
  EXPECT_NEAR(w.p_two_sided, 0.07939, 5e-6);
  EXPECT_NEAR(w.low, -3.3654832, 5e-6);
  EXPECT_NEAR(w.high, 0.2054832, 5e-6);
  EXPECT_EQ(p.degrees, 18);
  EXPECT_NEAR(p.p_two_sided, 0.07919, 5e-6);
  EXPECT_NEAR(pairs.t, -4.0621, 5e-5);
  EXPECT_EQ(pairs.degrees, 9);
  EXPECT_NEAR(pairs.p_two_sided, 0.002833, 5e-7);
  EXPECT_NEAR(pairs.difference, -1.58, 1e-12);
}

/// Schuirmann 1987: equivalent at 5 % exactly where the 90 % interval lies within the margin.
TEST(TTests, EquivalenceIsTwoOneSidedTests) {
  const TTest pairs = paired(kDrug1, kDrug2);
  const Equivalence wide = equivalenceOfPairs(kDrug1, kDrug2, 3);
  EXPECT_NEAR(wide.difference, -1.58, 1e-12);
  EXPECT_NEAR(wide.sd, 1.2299955, 5e-7);
  // t of 5 % and 9 degrees: 1.8331
  EXPECT_NEAR(wide.low, -1.58 - 1.8331 * 0.388959, 5e-5);
  EXPECT_NEAR(wide.high, -1.58 + 1.8331 * 0.388959, 5e-5);
  EXPECT_LT(wide.p, 0.05);
  EXPECT_GT(equivalenceOfPairs(kDrug1, kDrug2, 2).p, 0.05);
  EXPECT_NEAR(equivalenceOfPairs(kDrug1, kDrug2, -wide.low).p, 0.05, 1e-9);
  // A margin of 0 would ask whether the difference is positive and negative at once.
  EXPECT_NEAR(equivalenceOfPairs(kDrug1, kDrug2, 1e-12).p, pairs.p_greater, 1e-9);
  EXPECT_EQ(equivalenceOfPairs({1, 2, 3}, {1, 2, 3}, 0.1).p, 0);
  EXPECT_EQ(equivalenceOfPairs({1, 2, 3}, {3, 4, 5}, 0.1).p, 1);
  EXPECT_THROW(equivalenceOfPairs({1, 2}, {1, 2}, 0), Error);
  EXPECT_THROW(equivalenceOfPairs({1}, {1}, 1), Error);
  EXPECT_THROW(equivalenceOfPairs({1, 2}, {1, 2, 3}, 1), Error);
}

TEST(TTests, TailsAndDirection) {
  const TTest test = welch({1, 2, 3, 4}, {5, 6, 7, 9});
  EXPECT_LT(test.t, 0);
  EXPECT_NEAR(test.p_two_sided, 2 * test.p_less, 1e-12);
  EXPECT_NEAR(test.p_less + test.p_greater, 1, 1e-12);
  EXPECT_NEAR(welch({5, 6, 7, 9}, {1, 2, 3, 4}).p_greater, test.p_less, 1e-12);
}

TEST(TTests, EffectIsHedgesCorrected) {
  // Means 1 apart, standard deviation 1, 18 degrees: 1 x (1 - 3/71).
  EXPECT_NEAR(pooledFromMoments(Moments{1, 1, 10}, Moments{0, 1, 10}).effect, 1 - 3.0 / 71, 1e-12);
  EXPECT_NEAR(welchFromMoments(Moments{1, 1, 10}, Moments{0, 1, 10}).effect, 1 - 3.0 / 71, 1e-12);
}

TEST(TTests, RefuseWhatCannotBeTested) {
  EXPECT_THROW(welch({1}, {1, 2}), Error);
  EXPECT_THROW(welch({1, 1}, {2, 2}), Error);
  EXPECT_THROW(pooled({1, 1}, {2, 2}), Error);
  EXPECT_THROW(paired({1, 2, 3}, {1, 2}), Error);
  EXPECT_THROW(paired({1, 2, 3}, {2, 3, 4}), Error);  // all pairs differ alike
  EXPECT_THROW(welch({1, NAN}, {1, 2}), Error);
}

// NIST Statistical Reference Datasets, SiRstv: resistivity of silicon wafers with five instruments;
// certified values.
TEST(Anovas, NistSilicon) {
  const Anova a = oneWayAnova({{196.3052, 196.1240, 196.1890, 196.2569, 196.3403},
                               {196.3042, 196.3825, 196.1669, 196.3257, 196.0422},
                               {196.1303, 196.2005, 196.2889, 196.0343, 196.1811},
                               {196.2795, 196.1748, 196.1494, 196.1485, 195.9885},
                               {196.2119, 196.1051, 196.1850, 196.0052, 196.2090}});
  EXPECT_NEAR(a.f, 1.18046237440255, 1e-9);
  EXPECT_NEAR(a.squares_between, 5.11462616000000e-2, 1e-11);
  EXPECT_NEAR(a.squares_within, 2.16636560000000e-1, 1e-11);
  EXPECT_EQ(a.degrees_between, 4);
  EXPECT_EQ(a.degrees_within, 20);
}

// Dobson 1983: dried weights of plants under a control and two treatments.
TEST(Anovas, PlantGrowth) {
  const Anova a = oneWayAnova({{4.17, 5.58, 5.18, 6.11, 4.50, 4.61, 5.17, 4.53, 5.33, 5.14},
                               {4.81, 4.17, 4.41, 3.59, 5.87, 3.83, 6.03, 4.89, 4.32, 4.69},
                               {6.31, 5.12, 5.54, 5.50, 5.37, 5.29, 4.92, 6.15, 5.80, 5.26}});
  EXPECT_NEAR(a.f, 4.846, 5e-4);
  EXPECT_NEAR(a.p, 0.01591, 5e-6);
  EXPECT_NEAR(a.eta_squared, 0.2641, 5e-5);
  EXPECT_NEAR(a.omega_squared, (3.76634 - 2 * 0.388596) / (3.76634 + 10.49209 + 0.388596), 1e-5);
}

TEST(Anovas, TwoGroupsAreASquaredTTest) {
  const TTest t = pooled(kDrug1, kDrug2);
  const Anova a = oneWayAnova({kDrug1, kDrug2});
  EXPECT_NEAR(a.f, t.t * t.t, 1e-12);
  EXPECT_NEAR(a.p, t.p_two_sided, 1e-12);
  EXPECT_THROW(oneWayAnova({{1, 2}}), Error);
  EXPECT_THROW(oneWayAnova({{1}, {2}}), Error);
  EXPECT_THROW(oneWayAnova({{1, 1}, {2, 2}}), Error);
  EXPECT_THROW(oneWayAnova({{1, 2}, {}}), Error);
  EXPECT_THROW(fTail(1, 0, 3), Error);
}

// The step-down by hand: .005 x 4, .01 x 3, .03 x 2, then .04 x 1 lifted to .06.
TEST(Holm, StepsDown) {
  const std::vector<double> adjusted = holm({0.01, 0.04, 0.03, 0.005});
  const double expected[] = {0.03, 0.06, 0.06, 0.02};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(adjusted[i], expected[i], 1e-12);
  EXPECT_EQ(holm({0.6, 0.7})[0], 1);
  EXPECT_TRUE(holm({}).empty());
  EXPECT_THROW(holm({1.5}), Error);
}

/// 0.7 - 0.5 and 0.9 - 0.7 differ by rounding only: that is no spread.
TEST(Rounding, IsNoSpread) {
  EXPECT_THROW(oneWayAnova({{0.7 - 0.5, 0.9 - 0.7, 0.8 - 0.6}, {0.8 - 0.5, 0.9 - 0.6, 1.0 - 0.7}}),
               Error);
  EXPECT_THROW(welch({0.7 - 0.5, 0.9 - 0.7}, {0.8 - 0.5, 0.9 - 0.6}), Error);
  EXPECT_THROW(paired({0.7, 0.9, 0.8}, {0.5, 0.7, 0.6}), Error);
  EXPECT_NO_THROW(welch({1, 1 + 1e-12}, {2, 2}));
}

}  // namespace
}  // namespace palpa::statistics

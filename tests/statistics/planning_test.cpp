// Agreement of raters, power, CUSUM, shares.
#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "apps/assess/statistics/cusum.h"
#include "apps/assess/statistics/power.h"
#include "apps/assess/statistics/raters.h"
#include "apps/assess/statistics/tests_of_means.h"

namespace palpa::statistics {
namespace {

// Shrout and Fleiss 1979, table 2: six subjects, four judges; intervals as the psych package of R
// prints them.
TEST(Raters, ShroutAndFleiss) {
  Eigen::MatrixXd ratings(6, 4);
  ratings << 9, 2, 5, 8, 6, 1, 3, 2, 8, 4, 6, 8, 7, 1, 2, 6, 10, 5, 6, 9, 6, 2, 4, 7;
  const RaterAgreement a = raterAgreement(ratings);
  const auto expect = [](const Icc& icc, double value, double low, double high) {
    EXPECT_NEAR(icc.value, value, 0.005);
    EXPECT_NEAR(icc.low, low, 0.005);
    EXPECT_NEAR(icc.high, high, 0.005);
  };
  expect(a.one_way, 0.17, -0.133, 0.72);
  expect(a.agreement, 0.29, 0.019, 0.76);
  expect(a.consistency, 0.71, 0.342, 0.95);
  expect(a.one_way_mean, 0.44, -0.884, 0.91);
  expect(a.agreement_mean, 0.62, 0.071, 0.93);
  expect(a.consistency_mean, 0.91, 0.676, 0.99);
}

TEST(Raters, PerfectAgreementAndAStrictRater) {
  Eigen::MatrixXd same(3, 2), strict(3, 2);
  same << 1, 1, 2, 2, 5, 5;
  strict << 1, 0, 2, 1, 5, 4;
  EXPECT_EQ(raterAgreement(same).agreement.value, 1);
  EXPECT_EQ(raterAgreement(strict).consistency.value, 1);
  EXPECT_LT(raterAgreement(strict).agreement.value, 1);
  EXPECT_THROW(raterAgreement(same.leftCols(1)), Error);
  EXPECT_THROW(raterAgreement(Eigen::MatrixXd::Ones(3, 2)), Error);
  same(0, 0) = NAN;
  EXPECT_THROW(raterAgreement(same), Error);
}

/// Ratings whose table holds these counts.
std::pair<std::vector<int>, std::vector<int>> ratingsOf(
    const std::vector<std::vector<int>>& table) {
  std::pair<std::vector<int>, std::vector<int>> ratings;
  for (std::size_t r = 0; r < table.size(); ++r)
    for (std::size_t c = 0; c < table.size(); ++c)
      for (int i = 0; i < table[r][c]; ++i) {
        ratings.first.push_back(static_cast<int>(r));
        ratings.second.push_back(static_cast<int>(c));
      }
  return ratings;
}

// Fleiss, Cohen and Everitt 1969: two psychiatrists, shares of 100 patients; kappa .429.
TEST(Raters, FleissCohenEveritt) {
  const auto [one, other] = ratingsOf({{53, 5, 2}, {11, 14, 5}, {1, 6, 3}});
  EXPECT_NEAR(kappa(one, other, 3), 0.429, 0.0005);
}

TEST(Raters, WeightedKappaByHand) {
  const auto [one, other] = ratingsOf({{20, 5}, {10, 15}});
  for (const KappaWeights weights :
       {KappaWeights::none, KappaWeights::linear, KappaWeights::quadratic})
    EXPECT_NEAR(kappa(one, other, 2, weights), 0.4, 1e-12);
  // Three categories, one off by one and one off by two of four: observed linear (1 + 2) / 4;
  // expected by the margins 1 2 1 and 1 1 2.
  const std::vector<int> a{0, 1, 1, 2}, b{2, 1, 2, 0};
  const double expected_linear =
      (1.0 / 16) *
      (1 * (1 * 0 + 1 * 1 + 2 * 2) + 2 * (1 * 1 + 1 * 0 + 2 * 1) + 1 * (1 * 2 + 1 * 1 + 2 * 0));
  EXPECT_NEAR(kappa(a, b, 3, KappaWeights::linear), 1 - (5.0 / 4) / expected_linear, 1e-12);
  EXPECT_TRUE(std::isnan(kappa({1, 1}, {1, 1}, 2)));
  EXPECT_THROW(kappa({0}, {0, 1}, 2), Error);
  EXPECT_THROW(kappa({2}, {0}, 2), Error);
}

/// So many pairs without a true difference are found equivalent as often as planned.
TEST(Power, OfEquivalenceIsWhatDrawsShow) {
  constexpr double kMargin = 0.5;
  const int n = pairsForEquivalence(kMargin, 0.8);
  EXPECT_GE(powerOfEquivalence(kMargin, n), 0.8);
  EXPECT_LT(powerOfEquivalence(kMargin, n - 1), 0.8);
  RandomStream random(5, "test.equivalence");
  constexpr int kStudies = 2000;
  int shown = 0;
  for (int i = 0; i < kStudies; ++i) {
    std::vector<double> a, b(static_cast<std::size_t>(n), 0.0);
    for (int k = 0; k < n; ++k) a.push_back(random.normal());
    shown += equivalenceOfPairs(a, b, kMargin).p < 0.05;
  }
  const double power = powerOfEquivalence(kMargin, n);
  EXPECT_NEAR(static_cast<double>(shown) / kStudies, power,
              4 * std::sqrt(power * (1 - power) / kStudies));
  EXPECT_THROW(pairsForEquivalence(-0.5, 0.8), Error);
  EXPECT_THROW(pairsForEquivalence(0, 0.8), Error);
  EXPECT_THROW(powerOfEquivalence(0.5, 1), Error);
}

// Figures of power.t.test of R 4: n = 20, delta = 1: 0.8689528; power .90: 22.02110 a group; Cohen
// 1988: d = .5, power .80: 64.
TEST(Power, PublishedFigures) {
  EXPECT_NEAR(powerOfTwoGroups(1, 20, 20), 0.8689528, 5e-7);
  EXPECT_EQ(subjectsPerGroup(1, 0.90), 23);
  EXPECT_EQ(subjectsPerGroup(0.5, 0.80), 64);
  EXPECT_NEAR(powerOfTwoGroups(1, 20, 20, 0.05, Tails::one), 0.9279025, 5e-7);
  EXPECT_NEAR(powerOfPairs(0.5, 20), 0.5645044, 5e-7);
  EXPECT_EQ(subjectsPerGroupForRates(0.50, 0.75, 0.90), 77);
  EXPECT_THROW(subjectsPerGroup(0, 0.8), Error);
  EXPECT_THROW(subjectsPerGroup(0.001, 0.99), Error);
  EXPECT_THROW(subjectsPerGroup(1, 0.01), Error);
  EXPECT_THROW(powerOfTwoGroups(1, 1, 20), Error);
}

TEST(Power, IsHowOftenTheTestFindsIt) {
  RandomStream random = RandomStream::ofSeed(3);
  int found = 0;
  constexpr int kStudies = 2000;
  for (int s = 0; s < kStudies; ++s) {
    std::vector<double> a(10), b(10);
    for (double& v : a) v = random.openNormal() + 1;
    for (double& v : b) v = random.openNormal();
    found += pooled(a, b).p_two_sided < 0.05;
  }
  EXPECT_NEAR(found / static_cast<double>(kStudies), powerOfTwoGroups(1, 10, 10),
              0.033);  // three standard deviations
}

// Limits as tabulated for alpha = beta = 0.1.
TEST(Cusum, FourRows) {
  const struct {
    double p0, p1, s, h;
    int run;
  } rows[] = {{.10, .25, .166, 2.00, 13},
              {.10, .20, .145, 2.71, 19},
              {.05, .15, .092, 1.82, 20},
              {.05, .10, .072, 2.94, 41}};
  for (const auto& row : rows) {
    const CusumLimits limits = cusumLimits({row.p0, row.p1, 0.1, 0.1});
    EXPECT_NEAR(limits.s, row.s, 0.0005);
    EXPECT_NEAR(limits.h_accept, row.h, 0.005);
    EXPECT_NEAR(limits.h_reject, row.h, 0.005);
    EXPECT_EQ(limits.shortest_clean_run, row.run);
    std::vector<bool> clean(static_cast<std::size_t>(row.run), false);
    EXPECT_EQ(cusum(clean, limits).verdicts.back(), CusumVerdict::acceptable);
    clean.pop_back();
    EXPECT_EQ(cusum(clean, limits).last, CusumVerdict::undecided);
  }
}

TEST(Cusum, FailuresReject) {
  const CusumLimits limits = cusumLimits({});
  const Cusum chart = cusum({true, true, true, false}, limits);
  EXPECT_NEAR(chart.sums[1], 2 * (1 - limits.s), 1e-12);
  EXPECT_EQ(chart.verdicts[1], CusumVerdict::undecided);
  EXPECT_EQ(chart.verdicts[2], CusumVerdict::unacceptable);
  EXPECT_NEAR(chart.sums[3], -limits.s, 1e-12);  // starts anew
  EXPECT_EQ(chart.last, CusumVerdict::unacceptable);
  EXPECT_THROW(cusumLimits({.25, .10, .1, .1}), UsageError);
  EXPECT_THROW(cusumLimits({.1, .2, .6, .1}), UsageError);
}

/// Trainees who fail at the acceptable rate are called unacceptable about as often as alpha says,
/// and the other way round.
TEST(Cusum, ErrsAsOftenAsSaid) {
  const CusumLimits limits = cusumLimits({});
  const auto wrong = [&](double rate, CusumVerdict mistake) {
    RandomStream random = RandomStream::ofSeed(static_cast<std::uint64_t>(1000 * rate));
    int mistakes = 0;
    for (int trainee = 0; trainee < 2000; ++trainee) {
      std::vector<bool> failures;
      CusumVerdict verdict = CusumVerdict::undecided;
      while (verdict == CusumVerdict::undecided) {
        failures.push_back(random.openUniform() < rate);
        verdict = cusum(failures, limits).verdicts.back();
      }
      mistakes += verdict == mistake;
    }
    return mistakes / 2000.0;
  };
  EXPECT_LT(wrong(0.10, CusumVerdict::unacceptable), 0.12);  // Wald's limits are on the safe side
  EXPECT_LT(wrong(0.25, CusumVerdict::acceptable), 0.12);
}

}  // namespace
}  // namespace palpa::statistics

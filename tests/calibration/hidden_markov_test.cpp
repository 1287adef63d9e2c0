#include "calibration/parts/hidden_markov.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "calibration/parts/agreement.h"
#include "tests/calibration/planted_trials.h"
#include "tests/support/complaint.h"

namespace palpa::calibration {
namespace {

using palpa::test::complaint, palpa::test::says, test::PlantedTrials, test::plantedModel,
    test::simulated, test::mostLikelyOfAll;

bool sameBits(const HiddenMarkov& a, const HiddenMarkov& b) {
  return a.start == b.start && a.transition == b.transition && a.mean == b.mean &&
         a.variance == b.variance && a.climb == b.climb && a.log_likelihood == b.log_likelihood;
}

TEST(HiddenMarkov, FindsThePlantedModel) {
  const HiddenMarkov truth = plantedModel(3, 5);
  const PlantedTrials planted = simulated(truth, 1, 10, 600);
  const HiddenMarkov found = fitHiddenMarkov(planted.trials, 3, 7);
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.parameters(), 2 + 6 + 12);
  const std::vector<int> in_truth =
      bestMatching(contingencyOf(mostLikelyOfAll(found, planted.trials), planted.path()));
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::Index is = in_truth[static_cast<std::size_t>(k)];
    ASSERT_GE(is, 0);
    for (Eigen::Index d = 0; d < 2;
         ++d) {  // about 2000 steps a state: four standard errors of mean and variance
      const double variance = truth.variance(is, d);
      EXPECT_NEAR(found.mean(k, d), truth.mean(is, d), 4 * std::sqrt(variance / 2000));
      EXPECT_NEAR(found.variance(k, d), variance, 4 * variance * std::sqrt(2.0 / 2000));
    }
    for (Eigen::Index j = 0; j < 3; ++j)  // four standard errors of a share of 0.05
      EXPECT_NEAR(found.transition(k, j),
                  truth.transition(is, in_truth[static_cast<std::size_t>(j)]),
                  4 * std::sqrt(0.05 * 0.95 / 2000));
  }
}

TEST(HiddenMarkov, TheLikeliestPathIsThePlantedOne) {
  for (const int states : {2, 3, 4}) {
    const PlantedTrials planted = simulated(plantedModel(states, 4), 2);
    const HiddenMarkov found = fitHiddenMarkov(planted.trials, states, 7);
    const std::vector<int> path = mostLikelyOfAll(found, planted.trials);
    EXPECT_GT(cohensKappa(contingencyOf(path, planted.path())), 0.95) << states;
    EXPECT_GT(adjustedRandIndex(contingencyOf(path, planted.path())), 0.95) << states;
  }
}

TEST(HiddenMarkov, StatesComeInTheOrderInWhichTheyAreHeld) {
  HiddenMarkov m = plantedModel(4, 5);
  m.start << 0, 0, 1, 0;  // 2, 0, 3, 1, and there it ends
  m.transition << 0.98, 0, 0, 0.02, 0, 1, 0, 0, 0.02, 0, 0.98, 0, 0, 0.02, 0, 0.98;
  const PlantedTrials planted = simulated(m, 3);
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const HiddenMarkov found = fitHiddenMarkov(planted.trials, 4, seed);
    const Contingency table = contingencyOf(mostLikelyOfAll(found, planted.trials), planted.path());
    EXPECT_EQ(bestMatching(table), (std::vector<int>{2, 0, 3, 1}));
    EXPECT_GT(found.start[0], 0.99);
  }
}

/// Every path of states, one after the other: the oracle.
struct Enumerated {
  double likelihood = 0, best = 0;
  std::vector<int> path;
  Eigen::MatrixXd posterior;
};

Enumerated enumerated(const HiddenMarkov& m, const Eigen::MatrixXd& x) {
  const auto steps = static_cast<std::size_t>(x.rows());
  Enumerated all{0, 0, {}, Eigen::MatrixXd::Zero(x.rows(), m.states())};
  std::vector<int> path(steps, 0);
  for (std::size_t digit = 0; digit < steps;) {
    double p = m.start[path[0]];
    for (std::size_t t = 0; t < steps; ++t) {
      if (t > 0) p *= m.transition(path[t - 1], path[t]);
      for (Eigen::Index d = 0; d < x.cols(); ++d) {
        const double v = m.variance(path[t], d),
                     z = x(static_cast<Eigen::Index>(t), d) - m.mean(path[t], d);
        p *= std::exp(-0.5 * z * z / v) / std::sqrt(2 * std::numbers::pi * v);
      }
    }
    all.likelihood += p;
    for (std::size_t t = 0; t < steps; ++t)
      all.posterior(static_cast<Eigen::Index>(t), path[t]) += p;
    if (p > all.best) {
      all.best = p;
      all.path = path;
    }
    for (digit = 0; digit < steps && ++path[digit] == m.states(); ++digit) path[digit] = 0;
  }
  all.posterior /= all.likelihood;
  return all;
}

TEST(HiddenMarkov, AgreesWithAllPathsCountedOut) {
  HiddenMarkov m = plantedModel(3, 1.2);
  m.transition << 0.6, 0.4, 0, 0.1, 0.6, 0.3, 0.5, 0.2, 0.3;  // with a move that cannot be
  m.start << 0.5, 0, 0.5;
  m.variance << 1, 1e-6, 0.5, 2e-6, 2, 5e-7;
  for (const Eigen::MatrixXd& x : simulated(m, 4, 5, 7).trials) {
    const Enumerated all = enumerated(m, x);
    EXPECT_NEAR(logLikelihood(m, x), std::log(all.likelihood), 1e-9);
    EXPECT_EQ(mostLikely(m, x), all.path);
    EXPECT_TRUE(smoothed(m, x).isApprox(all.posterior, 1e-9));
    Eigen::VectorXd belief;
    for (Eigen::Index t = 0; t < x.rows(); ++t) {
      belief = filtered(m, belief, x.row(t).transpose());
      const Enumerated so_far = enumerated(m, x.topRows(t + 1));
      EXPECT_TRUE(belief.isApprox(so_far.posterior.row(t).transpose(), 1e-9)) << t;
    }
  }
}

TEST(HiddenMarkov, TheFilterEndsWhereTheSweepsDo) {
  const PlantedTrials planted = simulated(plantedModel(4, 2), 5, 4, 300);
  const HiddenMarkov found = fitHiddenMarkov(planted.trials, 4, 7);
  double sum = 0;
  for (const Eigen::MatrixXd& x : planted.trials) {
    Eigen::VectorXd belief;
    for (Eigen::Index t = 0; t < x.rows(); ++t) {
      belief = filtered(found, belief, x.row(t).transpose());
      ASSERT_NEAR(belief.sum(), 1, 1e-12);
      ASSERT_GE(belief.minCoeff(), 0);
    }
    const Eigen::MatrixXd afterwards = smoothed(found, x);
    EXPECT_TRUE(belief.isApprox(afterwards.bottomRows(1).transpose(), 1e-9));
    EXPECT_LT((afterwards.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-9);
    sum += logLikelihood(found, x);
  }
  EXPECT_NEAR(sum, found.log_likelihood, 1e-9 * std::abs(sum));
}

TEST(HiddenMarkov, TheFilterGoesOnWithoutARowThatIsNone) {
  const HiddenMarkov m = plantedModel(3, 4);
  Eigen::Vector3d belief(0.2, 0.5, 0.3);
  const Eigen::VectorXd moved = m.transition.transpose() * belief;
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300})
    EXPECT_TRUE(filtered(m, belief, Eigen::Vector2d(value, 7)).isApprox(moved, 1e-12)) << value;
  const Eigen::VectorXd far = filtered(
      m, belief, Eigen::Vector2d(1e4, 7));  // every density underflows; the nearest mean has it
  EXPECT_NEAR(far.sum(), 1, 1e-12);
  EXPECT_GT(far[1], 0.999);
}

TEST(HiddenMarkov, TheLikelihoodNeverFalls) {
  for (const double apart : {0.5, 2.0, 5.0}) {
    const PlantedTrials planted = simulated(plantedModel(3, apart), 6, 6, 150);
    for (const double least_variance : {1e-3, 0.7}) {  // the second is a limit that is met
      HiddenMarkovSettings settings;
      settings.starts = 2;
      settings.least_gain = 0;
      settings.most_iterations = 80;
      settings.least_variance = least_variance;
      const HiddenMarkov found = fitHiddenMarkov(planted.trials, 4, 7, settings);
      ASSERT_GT(found.climb.size(), 5u);
      for (std::size_t i = 1; i < found.climb.size(); ++i)
        EXPECT_GE(found.climb[i], found.climb[i - 1] - 1e-12 * std::abs(found.climb[i]))
            << apart << " " << i;
      EXPECT_EQ(found.climb.back(), found.log_likelihood);
      EXPECT_GT(found.transition.minCoeff(), 0);
      EXPECT_LT((found.transition.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
    }
  }
}

TEST(HiddenMarkov, SameSeedSameBits) {
  const PlantedTrials planted = simulated(plantedModel(3, 2), 9);
  const HiddenMarkov once = fitHiddenMarkov(planted.trials, 3, 11),
                     again = fitHiddenMarkov(planted.trials, 3, 11);
  EXPECT_TRUE(sameBits(once, again));
  HiddenMarkovSettings one_start;
  one_start.starts = 1;
  EXPECT_LE(fitHiddenMarkov(planted.trials, 3, 11, one_start).log_likelihood, once.log_likelihood);
}

TEST(HiddenMarkov, UnitsDoNotMatter) {
  const PlantedTrials planted = simulated(plantedModel(3, 3), 10);
  std::vector<Eigen::MatrixXd> other = planted.trials;
  for (Eigen::MatrixXd& t : other) t.col(0) = 1024 * t.col(0).array() - 3;
  const HiddenMarkov here = fitHiddenMarkov(planted.trials, 3, 7),
                     there = fitHiddenMarkov(other, 3, 7);
  EXPECT_EQ(mostLikelyOfAll(here, planted.trials), mostLikelyOfAll(there, other));
  EXPECT_TRUE(there.mean.col(0).isApprox((1024 * here.mean.col(0).array() - 3).matrix(), 1e-6));
  EXPECT_NEAR(there.log_likelihood, here.log_likelihood - 8 * 250 * std::log(1024.0),
              1e-6 * std::abs(here.log_likelihood));
}

TEST(HiddenMarkov, AFeatureThatIsOnOrOffIsNoTrouble) {
  PlantedTrials planted = simulated(plantedModel(2, 3), 12, 4, 200);
  for (std::size_t i = 0; i < planted.trials.size(); ++i)
    for (Eigen::Index t = 0; t < 200; ++t)
      planted.trials[i](t, 1) = planted.paths[i][static_cast<std::size_t>(t)];
  for (const int states : {1, 2, 5}) {
    const HiddenMarkov found = fitHiddenMarkov(planted.trials, states, 7);
    EXPECT_TRUE(std::isfinite(found.log_likelihood) && found.mean.allFinite() &&
                found.transition.allFinite())
        << states;
    EXPECT_GT(found.variance.minCoeff(), 0);
    if (states == 2) {
      EXPECT_NEAR(
          cohensKappa(contingencyOf(mostLikelyOfAll(found, planted.trials), planted.path())), 1,
          1e-12);
    }
  }
  EXPECT_TRUE(mostLikely(plantedModel(2, 3), Eigen::MatrixXd(0, 2)).empty());
}

TEST(HiddenMarkov, WhatTheTrialsCannotTellIsNamed) {
  const std::vector<Eigen::MatrixXd> good = simulated(plantedModel(2, 3), 13, 4, 50).trials;
  const auto fitOf = [](const std::vector<Eigen::MatrixXd>& trials, int states) {
    return complaint([&] { fitHiddenMarkov(trials, states, 1); });
  };
  const auto with = [&](const Eigen::MatrixXd& bad) {
    auto trials = good;
    trials[2] = bad;
    return fitOf(trials, 2);
  };
  EXPECT_EQ(fitOf(good, 2), "");
  EXPECT_TRUE(says(fitOf({}, 2), "no trial"));
  EXPECT_TRUE(says(fitOf(good, 0), "1 at least"));
  EXPECT_TRUE(says(fitOf(good, 12), "200 steps are too few for 12 states"));
  EXPECT_TRUE(says(with(good[2].topRows(1)), "trial 3 has fewer than two steps"));
  EXPECT_TRUE(says(with(good[2].leftCols(1)), "trial 3 has 1 features, trial 1 has 2"));
  Eigen::MatrixXd bad = good[2];
  bad(7, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(says(with(bad), "trial 3 holds a value that is not a number"));
  bad(7, 1) = 1e300;
  EXPECT_TRUE(says(with(bad), "feature 2 is too large"));
  auto still = good;
  for (Eigen::MatrixXd& t : still) t.col(1).setConstant(0.1);
  EXPECT_TRUE(says(fitOf(still, 2), "feature 2 never changes"));
  HiddenMarkovSettings none;
  none.least_variance = 0;
  EXPECT_TRUE(says(complaint([&] { fitHiddenMarkov(good, 2, 1, none); }), "the variance above 0"));

  const HiddenMarkov m = plantedModel(2, 3);
  EXPECT_TRUE(
      says(complaint([&] { mostLikely(m, good[0].leftCols(1)); }), "1 features, the model 2"));
  EXPECT_TRUE(
      says(complaint([&] { logLikelihood(m, bad * std::numeric_limits<double>::infinity()); }),
           "not a number"));
  EXPECT_TRUE(says(complaint([&] { filtered(m, {}, Eigen::Vector3d::Zero()); }),
                   "not of the model's size"));
  EXPECT_TRUE(
      says(complaint([&] { filtered(m, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()); }),
           "the belief is not a distribution"));
}

}  // namespace
}  // namespace palpa::calibration

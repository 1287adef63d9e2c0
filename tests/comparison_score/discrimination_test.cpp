#include "apps/assess/comparison/comparison_trial.h"
#include "apps/training/trial_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace palpa::assess {
namespace {

ComparisonTrial answer(double first, double second, int said) {
  ComparisonTrial trial;
  trial.outcome = training::Outcome::done;
  trial.factors = {first, second};
  trial.said = said;
  return trial;
}

/// Answers of somebody whose feeling scatters by `sd` of the logarithm.
std::vector<ComparisonTrial> answersOf(double sd, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> scatter(0, sd);
  const double ratios[] = {0.75, 0.87, 1.15, 1.33};
  std::vector<ComparisonTrial> trials;
  for (int i = 0; i < count; ++i) {
    const double second = ratios[i % 4];
    trials.push_back(
        answer(1, second, std::log(second) + scatter(random) > scatter(random) ? 2 : 1));
  }
  return trials;
}

TEST(ComparisonTrial, KnowsWhatIsRight) {
  EXPECT_TRUE(answer(1, 1.33, 2).right());
  EXPECT_FALSE(answer(1, 1.33, 1).right());
  EXPECT_TRUE(answer(1.33, 1, 1).right());
  EXPECT_FALSE(answer(1, 1.33, 0).answered());
  EXPECT_EQ(summaryOf(answer(1, 1.33, 2)), "Right: the second one was harder, by 33 %.");
  EXPECT_EQ(summaryOf(answer(1, 0.75, 2)), "Wrong: the first one was harder, by 33 %.");
  ComparisonTrial timed = answer(1, 1.33, 2);
  timed.outcome = training::Outcome::time;
  EXPECT_FALSE(timed.right());
}

TEST(Discrimination, CountsByRatioWhicheverCameFirst) {
  const Discrimination d =
      discriminationIn({answer(1, 1.25, 2), answer(1.25, 1, 2), answer(1, 2, 2), answer(1, 2, 0)},
                       ComparedProperty::stiffness);
  ASSERT_EQ(d.shares.size(), 2u);
  EXPECT_EQ(d.shares[0].right, 1);
  EXPECT_EQ(d.shares[0].of, 2);
  EXPECT_EQ(d.of, 3);
  EXPECT_FALSE(d.threshold) << "too few";
  EXPECT_EQ(discriminationIn({answer(1, 1.25, 2)}, ComparedProperty::weight).of, 0);
}

TEST(Discrimination, FindsTheThresholdItWasMadeWith) {
  for (const double sd : {0.08, 0.2}) {
    const std::optional<Threshold> found =
        discriminationIn(answersOf(sd, 4000, 5), ComparedProperty::stiffness).threshold;
    ASSERT_TRUE(found);
    EXPECT_NEAR(std::log(found->ratio), 0.67449 * std::sqrt(2.0) * sd, 0.08 * sd);
  }
}

/// About 95 of 100 intervals hold the truth.
TEST(Discrimination, ItsIntervalIsHonest) {
  const double truth = std::exp(0.67449 * std::sqrt(2.0) * 0.15);
  int holds = 0, told = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    const std::optional<Threshold> found =
        discriminationIn(answersOf(0.15, 80, seed), ComparedProperty::stiffness).threshold;
    if (!found) continue;
    ++told;
    holds += (!found->low || *found->low <= truth) && (!found->high || *found->high >= truth);
  }
  EXPECT_GT(told, 280);
  EXPECT_GT(holds, 0.91 * told);
  EXPECT_LT(holds, 0.99 * told);
}

TEST(Discrimination, AllRightOrChanceTellNoThreshold) {
  std::vector<ComparisonTrial> right(12, answer(1, 1.33, 2)), chance;
  for (int i = 0; i < 40; ++i) chance.push_back(answer(1, 1.33, 1 + i % 2));
  EXPECT_FALSE(discriminationIn(right, ComparedProperty::stiffness).threshold);
  const std::optional<Threshold> none =
      discriminationIn(chance, ComparedProperty::stiffness).threshold;
  EXPECT_TRUE(!none || !none->high);
}

/// Four surfaces, said in this order.
ComparisonTrial sorted(std::vector<double> factors, std::vector<int> order) {
  ComparisonTrial trial;
  trial.outcome = training::Outcome::done;
  trial.property = ComparedProperty::friction;
  trial.factors = std::move(factors);
  trial.order = std::move(order);
  return trial;
}

TEST(Sorting, KendallsTauCountsThePairsThatAreReversed) {
  const std::vector<double> factors{1.3, 0.6, 1.7, 1};
  EXPECT_EQ(sorted(factors, {2, 4, 1, 3}).trueOrder(), (std::vector<int>{2, 4, 1, 3}));
  const std::pair<std::vector<int>, double> expected[] = {
      {{2, 4, 1, 3}, 1},        // all six pairs as they are
      {{4, 2, 1, 3}, 4.0 / 6},  // neighbours changed: one pair
      {{2, 1, 3, 4}, 2.0 / 6},  // two pairs
      {{3, 1, 4, 2}, -1}};      // from the roughest
  for (const auto& [order, tau] : expected) {
    const ComparisonTrial trial = sorted(factors, order);
    ASSERT_TRUE(trial.tau());
    EXPECT_NEAR(*trial.tau(), tau, 1e-12);
    EXPECT_EQ(trial.right(), tau == 1);
  }
}

/// By chance: of all 24 orders the mean is 0 and the variance 2 (2 n + 5) / (9 n (n - 1)).
TEST(Sorting, OverAllOrdersTauHasKendallsMeanAndVariance) {
  std::vector<int> order{1, 2, 3, 4};
  double sum = 0, squares = 0;
  int count = 0;
  do {
    const double tau = sorted({0.6, 0.9, 1.2, 1.5}, order).tau().value();
    sum += tau;
    squares += tau * tau;
    ++count;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(count, 24);
  EXPECT_NEAR(sum / count, 0, 1e-12);
  EXPECT_NEAR(squares / count, 2.0 * (2 * 4 + 5) / (9 * 4 * 3), 1e-12);
}

TEST(Sorting, SaysTheOrderAndOnlyAWholeOneIsAnAnswer) {
  const std::vector<double> factors{1, 0.6, 1.7, 1.3};
  EXPECT_EQ(summaryOf(sorted(factors, {2, 1, 4, 3})),
            "Right: from the smoothest it is 2, 1, 4, 3.");
  EXPECT_EQ(summaryOf(sorted(factors, {1, 2, 4, 3})),
            "Wrong: said 1, 2, 4, 3; from the smoothest it is 2, 1, 4, 3 (tau 0.67).");
  for (const std::vector<int>& none :
       {std::vector<int>{}, {1, 2, 3}, {1, 1, 2, 3}, {0, 1, 2, 3}, {1, 2, 3, 4, 5}}) {
    const ComparisonTrial trial = sorted(factors, none);
    EXPECT_FALSE(trial.answered());
    EXPECT_FALSE(trial.tau());
    EXPECT_EQ(summaryOf(trial), "Nothing was said.");
  }
  EXPECT_EQ(discriminationIn({sorted(factors, {2, 1, 4, 3})}, ComparedProperty::friction).of, 0)
      << "an order is no answer about two";
}

TEST(ComparisonTrial, PropertiesHaveNamesAndWords) {
  for (const ComparedProperty property :
       {ComparedProperty::stiffness, ComparedProperty::weight, ComparedProperty::friction})
    EXPECT_EQ(propertyNamed(nameOf(property)), property);
  EXPECT_FALSE(propertyNamed("colour"));
  ComparisonTrial trial = answer(1, 1.25, 2);
  trial.property = ComparedProperty::friction;
  EXPECT_EQ(summaryOf(trial), "Right: the second one was rougher, by 25 %.");
}

}  // namespace
}  // namespace palpa::assess

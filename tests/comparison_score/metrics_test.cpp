#include "apps/assess/comparison/comparison_trial.h"
#include "apps/training/trial_words.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace palpa::assess {
namespace {

using Expected = std::vector<std::pair<const char*, double>>;

void expectMetrics(const ComparisonTrial& trial, const Expected& expected, const char* engine) {
  const auto all = comparisonMetrics(trial);
  ASSERT_EQ(all.size(), expected.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].name, expected[i].first);
    EXPECT_NEAR(all[i].value, expected[i].second, 1e-9) << all[i].name;
    EXPECT_TRUE(metrics::metricNamed(all[i].name) &&
                metrics::belongsTo(*metrics::metricNamed(all[i].name), engine))
        << all[i].name;
  }
}

TEST(ComparisonMetrics, OfAComparisonMadeByHand) {
  ComparisonTrial trial;
  trial.outcome = training::Outcome::done;
  trial.factors = {1.0, 1.25};
  trial.said = 2;
  trial.seconds = 12;
  trial.peak_N = 4;
  trial.touches = {2, 3};
  const Expected expected = {
      {"success", 1}, {"time_s", 12}, {"difference_pct", 25}, {"grips", 5}, {"peak_force_N", 4}};
  expectMetrics(trial, expected, "squeeze");
  trial.said = 1;
  EXPECT_EQ(comparisonMetrics(trial)[0].value, 0);
}

TEST(ComparisonMetrics, OfASortingMadeByHand) {
  ComparisonTrial trial;
  trial.outcome = training::Outcome::done;
  trial.property = ComparedProperty::friction;
  trial.factors = {0.6, 1.3, 1, 1.7};
  trial.order = {1, 2, 3, 4};
  trial.seconds = 60;
  trial.peak_N = 0.7;
  trial.touches = {1, 2, 1, 1};
  const Expected expected = {{"success", 0},
                             {"time_s", 60},
                             {"order_tau", 4.0 / 6},
                             {"touches", 5},
                             {"peak_force_N", 0.7}};
  expectMetrics(trial, expected, "friction");
}

}  // namespace
}  // namespace palpa::assess

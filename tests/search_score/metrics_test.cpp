#include "apps/assess/search/search_trial.h"
#include "apps/training/trial_words.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpa::assess {
namespace {

double figure(const SearchTrial& trial, const char* name) {
  for (const metrics::MetricValue& m : searchMetrics(trial))
    if (m.name == name) return m.value;
  ADD_FAILURE() << name;
  return 0;
}

TEST(SearchMetrics, OfAnEpisodeMadeByHand) {
  SearchTrial trial;
  trial.outcome = training::Outcome::done;
  trial.target = 2;
  trial.chosen = 2;
  trial.seconds = 20;
  trial.path_m = 0.5;
  trial.peak_force_N = 3;
  trial.mean_force_N = 1.5;
  EXPECT_EQ(figure(trial, "success"), 1);
  EXPECT_EQ(figure(trial, "chosen"), 1);
  EXPECT_EQ(figure(trial, "time_s"), 20);
  EXPECT_NEAR(figure(trial, "path_length_mm"), 500, 1e-9);
  EXPECT_NEAR(figure(trial, "mean_speed_mm_s"), 25, 1e-9);
  EXPECT_EQ(figure(trial, "peak_force_N"), 3);
  EXPECT_EQ(figure(trial, "mean_force_N"), 1.5);
  trial.chosen = 0;
  EXPECT_EQ(figure(trial, "success"), 0);
  EXPECT_TRUE(std::isnan(figure(SearchTrial{}, "mean_speed_mm_s")));
  for (const metrics::MetricValue& m : searchMetrics(trial))
    EXPECT_TRUE(metrics::metricNamed(m.name) &&
                metrics::belongsTo(*metrics::metricNamed(m.name), "search"))
        << m.name;
}

}  // namespace
}  // namespace palpa::assess

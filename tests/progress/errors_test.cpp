#include <gtest/gtest.h>

#include <cmath>

#include "apps/assess/progress/cohort.h"
#include "apps/training/engine.h"
#include "practice.h"

namespace palpa::progress {
namespace {

using test::cleanTrial;
using test::set;

Series practice(const std::vector<std::string>& trainees, int each) {
  std::vector<PracticeTrial> trials;
  for (const std::string& trainee : trainees)
    for (int i = 1; i <= each; ++i) trials.push_back(cleanTrial(trainee, i));
  return seriesOf(trials).at(0);
}

TEST(Errors, EveryKindRestsOnAFigureOfItsEngine) {
  using training::Engine;
  for (const Engine engine : {Engine::needle, Engine::palpation, Engine::search, Engine::squeeze,
                              Engine::friction, Engine::pulse}) {
    EXPECT_FALSE(errorKinds(engine).empty());
    for (const ErrorKind& kind : errorKinds(engine)) {
      const metrics::MetricDefinition* definition = metrics::metricNamed(kind.metric);
      ASSERT_NE(definition, nullptr) << kind.metric;
      EXPECT_TRUE(metrics::belongsTo(*definition, training::nameOf(engine))) << kind.metric;
      EXPECT_EQ(definition->better, kind.below ? metrics::Better::higher : metrics::Better::lower)
          << kind.metric;
    }
  }
}

TEST(Errors, ACleanTrialHasNone) { EXPECT_TRUE(errorsIn(practice({"A"}, 6)).empty()); }

TEST(Errors, WhatHappenedAgainLatelyRecurs) {
  Series series = practice({"A"}, 10);
  set(series.trials[0], "col_rib", 3);
  set(series.trials[1], "col_rib", 3);
  set(series.trials[6], "col_lung", 1);
  set(series.trials[9], "col_lung", 2);
  const auto errors = errorsIn(series);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_STREQ(errors[0].kind->metric, "col_lung");
  EXPECT_TRUE(errors[0].recurs());
  EXPECT_EQ(errors[0].all.with, 2);
  EXPECT_EQ(errors[0].all.of, 10);
  EXPECT_EQ(errors[1].all.with, 2);
  EXPECT_EQ(errors[1].lately.with, 0);
  EXPECT_FALSE(errors[1].recurs());
}

TEST(Costs, TheyAddUpToTheTotal) {
  Series series = practice({"A"}, 5);
  const auto costs = costsLately(series);
  ASSERT_EQ(costs.size(), 4u);  // nothing was touched; a direction below 1000 costs nothing
  EXPECT_STREQ(costs[0].metric, "time_s");
  EXPECT_NEAR(costs[0].points, 200, 1e-9);
  EXPECT_NEAR(costs[1].points, 80, 1e-9);
  double sum = 0;
  for (const Cost& cost : costs) sum += cost.points;
  EXPECT_NEAR(sum, series.trials[0].metric("total"), 1e-9);
}

TEST(Costs, ATaskThatWeighsOtherwiseHasNone) {
  Series series = practice({"A"}, 5);
  set(series.trials[4], "total", 123);
  EXPECT_TRUE(costsLately(series).empty());
  series.trials[4].figures = {{"success", 1}};
  EXPECT_TRUE(costsLately(series).empty());
}

TEST(Misses, TheNearestFirstAndNoneThatTouched) {
  Series series = practice({"A"}, 5);
  set(series.trials[1], "closest_pleura_mm", 1.5);
  set(series.trials[3], "closest_pleura_mm", -0.5);
  const auto misses = nearestMisses(series, "pleura", 2);
  ASSERT_EQ(misses.size(), 2u);
  EXPECT_EQ(misses[0].trial, 2u);
  EXPECT_NEAR(misses[0].distance_mm, 1.5, 1e-12);
  EXPECT_NEAR(misses[1].distance_mm, 9, 1e-12);
  EXPECT_TRUE(nearestMisses(series, "artery").empty());
}

TEST(Cohort, AnErrorsShareIsTheTraineesMeanNotTheTrials) {
  Series group = practice({"A"}, 10);  // A: never; B: always, in two trials; C: never
  const Series b = practice({"B"}, 2), c = practice({"C"}, 4);
  group.trials.insert(group.trials.end(), b.trials.begin(), b.trials.end());
  group.trials.insert(group.trials.end(), c.trials.begin(), c.trials.end());
  set(group.trials[10], "col_rib", 1);
  set(group.trials[11], "col_rib", 1);
  const auto errors = commonErrors(group);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].with, 2);
  EXPECT_EQ(errors[0].trials, 16);
  EXPECT_EQ(errors[0].trainees_with, 1);
  EXPECT_NEAR(errors[0].share.mean, 1.0 / 3, 1e-12);
  EXPECT_TRUE(errors[0].share.interval);
}

TEST(Cohort, AFigureIsOfTheLatestTrials) {
  Series group = practice({"A", "B"}, 8);
  for (std::size_t i = 0; i < 3; ++i) set(group.trials[i], "time_s", 1000);
  for (std::size_t i = 3; i < 8; ++i) set(group.trials[i], "time_s", 10 + static_cast<double>(i));
  const auto figures = traineeFigures(group, "time_s");
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_NEAR(figures[0].mean, 15, 1e-12);
  ASSERT_TRUE(figures[0].interval);
  EXPECT_LT(figures[0].interval->first, 15);
  EXPECT_GT(figures[0].interval->second, 15);
  EXPECT_EQ(figures[1].interval->first, 20);  // nothing varies
}

TEST(Cohort, TheGroupsCurveEndsWhereFewAreLeft) {
  Series group = practice({"A", "B", "C", "D"}, 6);
  const Series more = practice({"E"}, 9);
  group.trials.insert(group.trials.end(), more.trials.begin(), more.trials.end());
  const GroupCurve curve = groupCurve(group, "total");
  EXPECT_EQ(curve.curves.size(), 5u);
  EXPECT_EQ(curve.mean.size(), 6u);
  EXPECT_EQ(curve.mean[0].trainees, 5u);
  EXPECT_TRUE(groupCurve(practice({"A", "B"}, 6), "total").mean.empty());
}

TEST(Cohort, WhoHarmsNeedsAttentionAndWhoDoesNotDoesNot) {
  Series group = practice({"A", "B"}, 14);
  for (std::size_t i = 23; i < 28; ++i)
    set(group.trials[i], "col_lung", 3);  // 9 x -0.166, then 5 x 0.834: 2.68 > 2.00
  const auto attention = whoNeedsAttention(group, {});
  ASSERT_EQ(attention.size(), 1u);
  EXPECT_EQ(attention[0].trainee, "B");
  ASSERT_EQ(attention[0].reasons.size(), 3u);
  EXPECT_EQ(attention[0].reasons[0], "the pleura was touched in 5 of the last 5 trials");
  EXPECT_EQ(attention[0].reasons[1], "the CUSUM found the unacceptable failure rate at trial 14");
}

TEST(Cohort, ReliabilityNeedsEightCasesAndADifference) {
  Series group = practice({"A", "B", "C"}, 8);
  EXPECT_FALSE(reliabilityOf(group, "time_s"));  // all alike
  for (std::size_t i = 0; i < group.trials.size(); ++i)
    set(group.trials[i], "time_s",
        10 * static_cast<double>(i / 8) + 0.1 * static_cast<double>(i * 7 % 5));
  const auto reliable = reliabilityOf(group, "time_s");
  ASSERT_TRUE(reliable);
  EXPECT_EQ(reliable->trainees, 3u);
  EXPECT_GT(reliable->icc.value, 0.99);
  EXPECT_FALSE(reliabilityOf(practice({"A", "B"}, 7), "time_s"));
}

}  // namespace
}  // namespace palpa::progress

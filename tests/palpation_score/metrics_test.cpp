#include "apps/assess/palpation/palpation_assessment.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpa::assess {
namespace {

TEST(PalpationMetrics, OfAScoreMadeByHand) {
  PalpationAssessment a;
  a.score.found = 3;
  a.score.missed = 1;
  a.score.false_alarms = 2;
  a.score.clear_quadrants = 2;
  a.score.wrong_quadrants = 1;
  a.score.coverage = {0.9, 0.8, 0.5};
  a.score.seconds = 60;
  a.score.presses = 40;
  a.score.peak = 6;
  a.score.mean = 2;
  a.score.too_light = 0.25;
  a.score.too_hard = 0.1;
  a.score.twice = 0.3;
  const auto figure = [&](const char* name) {
    for (const metrics::MetricValue& m : palpationMetrics(a))
      if (m.name == name) return m.value;
    ADD_FAILURE() << name;
    return 0.0;
  };
  EXPECT_EQ(figure("success"), 0);
  EXPECT_NEAR(figure("sensitivity_pct"), 75, 1e-9);
  EXPECT_NEAR(figure("specificity_pct"), 50, 1e-9);
  EXPECT_EQ(figure("false_alarms"), 2);
  EXPECT_NEAR(figure("coverage_light_pct"), 90, 1e-9);
  EXPECT_NEAR(figure("coverage_medium_pct"), 80, 1e-9);
  EXPECT_NEAR(figure("coverage_deep_pct"), 50, 1e-9);
  EXPECT_NEAR(figure("felt_twice_pct"), 30, 1e-9);
  EXPECT_NEAR(figure("too_hard_pct"), 10, 1e-9);
  EXPECT_EQ(figure("presses"), 40);
  EXPECT_NEAR(figure("too_light_pct"), 25, 1e-9);
  EXPECT_EQ(figure("peak_force_N"), 6);
  EXPECT_TRUE(std::isnan(figure("closer_force_ratio")));
  a.score = {};
  EXPECT_TRUE(std::isnan(figure("sensitivity_pct")));
  EXPECT_TRUE(std::isnan(figure("mean_force_N")));
  for (const metrics::MetricValue& m : palpationMetrics(a))
    EXPECT_TRUE(metrics::metricNamed(m.name) &&
                metrics::belongsTo(*metrics::metricNamed(m.name), "palpation"))
        << m.name;
}

}  // namespace
}  // namespace palpa::assess

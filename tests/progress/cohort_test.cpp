#include "apps/assess/progress/cohort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "anatomy/base/random.h"
#include "apps/assess/statistics/sample.h"
#include "practice.h"

/// The figures of a cohort beside the same computed from its definition: trainee by trainee, value
/// by value, each interval by the bootstrap that takes any figure.
namespace palpa::progress {
namespace {

using Values = std::vector<double>;
using Interval = std::optional<std::pair<double, double>>;

constexpr int kTrainees = 40;

std::string nameOf(int trainee) { return "T" + std::to_string(100 + trainee); }

/// 1,000 trials: 15 to 34 of each of 40 trainees; now and then a figure does not apply.
Series drawnCohort() {
  RandomStream random = RandomStream::ofSeed(33);
  std::vector<PracticeTrial> trials;
  for (int t = 0; t < kTrainees; ++t)
    for (int n = 1; n <= 15 + t % 20 + t / 20; ++n) {
      PracticeTrial trial = test::cleanTrial(nameOf(t), n);
      const double ill = std::exp(-n / 8.0) + 0.02 * t;
      test::set(trial, "time_s", 20 + 40 * ill * random.openUniform());
      test::set(trial, "success", random.openUniform() > 0.4 * ill ? 1 : 0);
      test::set(trial, "col_lung", random.openUniform() < 0.3 * ill ? 2 : 0);
      test::set(trial, "col_rib", random.openUniform() < ill ? 1 : 0);
      test::set(trial, "needle_passes", 1 + std::floor(5 * ill * random.openUniform()));
      test::set(trial, "phase_2", 1500 * random.openUniform());
      test::set(trial, "closest_pleura_mm",
                random.openUniform() < 0.2 ? std::nan("") : 9 * random.openUniform());
      trials.push_back(trial);
    }
  return seriesOf(trials).at(0);
}

std::map<std::string, Values> valuesByTrainee(const Series& group, const std::string& metric) {
  std::map<std::string, Values> all;
  for (const PracticeTrial& trial : group.trials)
    all[trial.trainee].push_back(trial.metric(metric));
  return all;
}

Values numbersIn(Values values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  return values;
}

Interval intervalOfMean(const Values& values) {
  if (values.size() < 3) return std::nullopt;
  const auto all = statistics::bootstrap(
      {values}, [](const statistics::Samples& s) { return statistics::meanOf(s[0]); });
  return std::pair{all.low, all.high};
}

void expectSame(const Interval& is, const Interval& should) {
  ASSERT_EQ(is.has_value(), should.has_value());
  if (!is) return;
  EXPECT_NEAR(is->first, should->first, 1e-9 * (1 + std::abs(should->first)));
  EXPECT_NEAR(is->second, should->second, 1e-9 * (1 + std::abs(should->second)));
}

class CohortFigures : public testing::Test {
 protected:
  const Series group_ = drawnCohort();
};

TEST_F(CohortFigures, CommonErrorsByTheirDefinition) {
  ASSERT_EQ(group_.trials.size(), 1000u);
  const std::vector<CommonError> errors = commonErrors(group_);
  EXPECT_GE(errors.size(), 6u);
  for (const CommonError& error : errors) {
    Values shares;
    int with = 0, of = 0;
    for (const auto& [trainee, values] : valuesByTrainee(group_, error.kind->metric)) {
      const Values known = numbersIn(values);
      const auto hits = std::count_if(known.begin(), known.end(), [&](double v) {
        return error.kind->below ? v < error.kind->above : v > error.kind->above;
      });
      with += static_cast<int>(hits);
      of += static_cast<int>(known.size());
      shares.push_back(static_cast<double>(hits) / static_cast<double>(known.size()));
    }
    EXPECT_EQ(error.with, with) << error.kind->words;
    EXPECT_EQ(error.trials, of);
    EXPECT_EQ(error.share.mean, statistics::meanOf(shares));
    expectSame(error.share.interval, intervalOfMean(shares));
  }
}

TEST_F(CohortFigures, TraineesFiguresByTheirDefinition) {
  for (const char* metric : {"time_s", "closest_pleura_mm", "needle_passes"}) {
    const auto all = valuesByTrainee(group_, metric);
    const std::vector<TraineeFigure> figures = traineeFigures(group_, metric);
    ASSERT_EQ(figures.size(), static_cast<std::size_t>(kTrainees));
    for (const TraineeFigure& figure : figures) {
      Values latest = numbersIn(all.at(figure.trainee));
      latest.erase(latest.begin(), latest.end() - 5);
      EXPECT_EQ(figure.values, latest);
      EXPECT_EQ(figure.mean, statistics::meanOf(latest));
      expectSame(figure.interval, intervalOfMean(latest));
    }
  }
}

TEST_F(CohortFigures, TheGroupsCurveByItsDefinition) {
  const auto all = valuesByTrainee(group_, "closest_pleura_mm");
  const GroupCurve curve = groupCurve(group_, "closest_pleura_mm");
  EXPECT_GE(curve.mean.size(), 15u);
  for (std::size_t n = 0; n < curve.mean.size(); ++n) {
    Values at_trial;
    for (const auto& [trainee, values] : all)
      if (n < values.size()) at_trial.push_back(values[n]);
    at_trial = numbersIn(at_trial);
    EXPECT_EQ(curve.mean[n].trainees, at_trial.size());
    EXPECT_EQ(curve.mean[n].mean, statistics::meanOf(at_trial));
    expectSame(curve.mean[n].interval, intervalOfMean(at_trial));
  }
}

TEST_F(CohortFigures, SeveralCurvesAtOnceAreThoseOfEach) {
  const std::vector<std::string> metrics{"time_s", "closest_pleura_mm", "total"};
  const std::vector<GroupCurve> together = groupCurves(group_, metrics);
  ASSERT_EQ(together.size(), metrics.size());
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    const GroupCurve alone = groupCurve(group_, metrics[m]);
    ASSERT_EQ(together[m].mean.size(), alone.mean.size());
    EXPECT_EQ(together[m].curves.size(), alone.curves.size());
    for (std::size_t n = 0; n < alone.mean.size(); ++n) {
      EXPECT_EQ(together[m].mean[n].mean, alone.mean[n].mean);
      EXPECT_EQ(together[m].mean[n].interval, alone.mean[n].interval);
    }
  }
}

}  // namespace
}  // namespace palpa::progress

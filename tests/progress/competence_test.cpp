#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "apps/assess/progress/competence.h"
#include "practice.h"

namespace palpa::progress {
namespace {

struct Row {
  double acceptable, unacceptable, s, h;
  std::size_t clean;
};
constexpr Row kRows[] = {{0.10, 0.25, 0.166, 2.00, 13},
                         {0.10, 0.20, 0.145, 2.71, 19},
                         {0.05, 0.15, 0.092, 1.82, 20},
                         {0.05, 0.10, 0.072, 2.94, 41}};

TEST(Competence, TheShortestCleanRunCertifiesAndOneLessDoesNot) {
  for (const Row& row : kRows) {
    const statistics::CusumRates rates{row.acceptable, row.unacceptable};
    const Competence just = competenceOf(std::vector<bool>(row.clean, false), rates),
                     short_of = competenceOf(std::vector<bool>(row.clean - 1, false), rates);
    EXPECT_NEAR(just.limits.s, row.s, 5e-4);
    EXPECT_NEAR(just.limits.h_accept, row.h, 5e-3);
    EXPECT_EQ(just.minimum, row.clean);
    ASSERT_TRUE(just.reached) << row.acceptable;
    EXPECT_EQ(*just.reached, row.clean);
    EXPECT_EQ(just.still_clean, 0u);
    EXPECT_FALSE(short_of.reached);
    EXPECT_TRUE(short_of.tooFew());
    EXPECT_EQ(short_of.still_clean, 1u);
  }
}

TEST(Competence, WhatIsStillNeededSuffices) {
  std::vector<bool> failures{true, false, false, true, false, false, false};
  const Competence now = competenceOf(failures, {});
  ASSERT_FALSE(now.reached);
  failures.insert(failures.end(), now.still_clean - 1, false);
  EXPECT_FALSE(competenceOf(failures, {}).reached);
  failures.push_back(false);
  EXPECT_EQ(competenceOf(failures, {}).reached, failures.size());
}

TEST(Competence, AnUnacceptableRateTakesItBack) {
  std::vector<bool> failures(13, false);
  failures.insert(failures.end(), {true, true, true});  // 3 x 0.834 = 2.50 > 2.00
  const Competence c = competenceOf(failures, {});
  EXPECT_FALSE(c.reached);
  ASSERT_TRUE(c.lost);
  EXPECT_EQ(*c.lost, 16u);
  EXPECT_EQ(c.still_clean, 13u);  // the test begins anew
  failures.insert(failures.end(), 13, false);
  const Competence again = competenceOf(failures, {});
  EXPECT_EQ(again.reached, 29u);
  EXPECT_FALSE(again.lost);
}

TEST(Competence, RatesOutOfOrderAreRefused) {
  EXPECT_THROW(competenceOf({false}, {0.3, 0.2}), UsageError);
}

TEST(Retention, DatesAreCalendarDates) {
  EXPECT_EQ(monthsLater("2027-03-01T10:00:00Z", 6), "2027-09-01");
  EXPECT_EQ(monthsLater("2027-08-31", 6), "2028-02-29");  // a leap year
  EXPECT_EQ(monthsLater("soon", 6), "");
  EXPECT_EQ(daysBetween("2027-02-27", "2027-03-01T23:00:00Z"), 2);
  EXPECT_EQ(daysBetween("2027-03-01", "2027-02-27"), -2);
  EXPECT_FALSE(daysBetween("", "2027-02-27"));
  EXPECT_FALSE(daysBetween("2027-02-30", "2027-03-01"));
  EXPECT_EQ(retentionTests("2027-03-01")->twelve_months, "2028-03-01");
  EXPECT_FALSE(retentionTests(""));
}

Series pausedAfterSix(const std::string& later) {
  std::vector<PracticeTrial> trials;
  for (int i = 0; i < 12; ++i) {
    PracticeTrial t = test::cleanTrial("A", i + 1, i < 6 ? "2027-01-10T09:00:00Z" : later);
    t.arrival = i < 6 ? 1 : 2;
    test::set(t, "time_s", i < 6 ? 10 + i % 2 : 20 + i % 2);  // 11, 10, 11 before; 20, 21, 20 after
    trials.push_back(t);
  }
  return seriesOf(trials).at(0);
}

TEST(Retention, APauseShowsWhatItCost) {
  const auto gaps = retentionGaps(pausedAfterSix("2027-07-12T09:00:00Z"), "time_s");
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps[0].days, 183);
  EXPECT_NEAR(gaps[0].before, 32.0 / 3, 1e-12);
  EXPECT_NEAR(gaps[0].after, 61.0 / 3, 1e-12);
  EXPECT_NEAR(gaps[0].loss, 29.0 / 3, 1e-12);
  ASSERT_TRUE(gaps[0].interval);
  EXPECT_GT(gaps[0].interval->first, 8);
  EXPECT_LT(gaps[0].interval->second, 12);
}

TEST(Retention, WhereMoreIsBetterALossIsLess) {
  Series series = pausedAfterSix("2027-02-10T09:00:00Z");
  for (std::size_t i = 6; i < 12; ++i) test::set(series.trials[i], "closest_pleura_mm", 4);
  const auto gaps = retentionGaps(series, "closest_pleura_mm");
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_NEAR(gaps[0].loss, 5, 1e-12);
}

TEST(Retention, NoPauseBetweenDaysOrByAClockThatRanBackwards) {
  EXPECT_TRUE(retentionGaps(pausedAfterSix("2027-01-16T09:00:00Z"), "time_s").empty());
  EXPECT_TRUE(retentionGaps(pausedAfterSix("1970-01-01T00:00:00Z"), "time_s").empty());
  EXPECT_TRUE(retentionGaps(pausedAfterSix("2027-07-12T09:00:00Z"), "mean_speed_mm_s").empty());
}

}  // namespace
}  // namespace palpa::progress

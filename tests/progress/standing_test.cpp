#include "apps/assess/progress/standing.h"

#include <gtest/gtest.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "practice.h"

namespace palpa::progress {
namespace {

/// Trainees T0, T1, ...; of each `trials` trials whose time is 10, 20, ... s by the trainee.
Series groupOf(int trainees, int trials = 5) {
  std::vector<PracticeTrial> all;
  for (int t = 0; t < trainees; ++t)
    for (int n = 1; n <= trials; ++n) {
      all.push_back(test::cleanTrial("T" + std::to_string(t), n));
      test::set(all.back(), "time_s", 10.0 * (t + 1));
    }
  return seriesOf(all).at(0);
}

TEST(Standing, OthersAreTheMiddleHalfOfThem) {
  const auto others = othersIn(groupOf(10), "T9");
  ASSERT_TRUE(others);
  EXPECT_EQ(others->people, 9u);
  EXPECT_EQ(others->trials, 45u);
  const Reach* time = others->reach("time_s");
  ASSERT_TRUE(time);
  EXPECT_DOUBLE_EQ(time->low, 30);  // of 10, 20, ... 90
  EXPECT_DOUBLE_EQ(time->middle, 50);
  EXPECT_DOUBLE_EQ(time->high, 70);
}

TEST(Standing, FewOthersAreNotShown) {
  EXPECT_FALSE(othersIn(groupOf(7), "")) << "they could be told apart";
  EXPECT_FALSE(othersIn(groupOf(8), "T2")) << "seven others";
  EXPECT_TRUE(othersIn(groupOf(8), "somebody else"));
}

TEST(Standing, AFigureThatFewOthersHaveIsNotShown) {
  std::vector<PracticeTrial> all = groupOf(9).trials;
  for (PracticeTrial& trial : all)
    if (trial.trainee < "T2") test::set(trial, "closest_pleura_mm", std::nan(""));
  const auto others = othersIn(seriesOf(all).at(0), "");
  ASSERT_TRUE(others);
  EXPECT_FALSE(others->reach("closest_pleura_mm"));
  EXPECT_TRUE(others->reach("time_s"));
}

TEST(Standing, OfExpertsEightOfTenTrials) {
  std::vector<PracticeTrial> trials;
  for (int i = 0; i <= 10; ++i) {
    trials.push_back(test::cleanTrial(i % 2 ? "A" : "B", i + 1));
    test::set(trials.back(), "total", 100.0 * i);
    trials.back().simulated = i == 4;  // any
  }
  trials.push_back(trials.back());
  trials.back().role = training::Role::familiarisation;
  test::set(trials.back(), "total", 99999);
  const auto experts = expertsOf(trials);
  ASSERT_TRUE(experts);
  EXPECT_TRUE(experts->simulated);
  EXPECT_EQ(experts->people, 2u);
  EXPECT_EQ(experts->trials, 11u);
  EXPECT_DOUBLE_EQ(experts->reach("total")->low, 100);
  EXPECT_DOUBLE_EQ(experts->reach("total")->middle, 500);
  EXPECT_DOUBLE_EQ(experts->reach("total")->high, 900);
  EXPECT_FALSE(expertsOf({}));
}

TEST(Standing, IsReadAsItWasWritten) {
  const auto others = othersIn(groupOf(9), "");
  ASSERT_TRUE(others);
  const Group again = groupIn(nlohmann::json::parse(jsonOf(*others).dump()));
  EXPECT_EQ(again.name, others->name);
  EXPECT_EQ(again.people, others->people);
  ASSERT_EQ(again.figures.size(), others->figures.size());
  EXPECT_DOUBLE_EQ(again.reach("time_s")->high, others->reach("time_s")->high);
  EXPECT_THROW(groupIn(nlohmann::json::object()), nlohmann::json::exception);
}

}  // namespace
}  // namespace palpa::progress

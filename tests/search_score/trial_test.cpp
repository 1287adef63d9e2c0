#include <gtest/gtest.h>

#include <cmath>

#include "apps/assess/statistics/sample.h"
#include "apps/training/trial_words.h"
#include "synthetic_search.h"

namespace palpa::assess {
namespace {

using namespace test;

SearchTrial endedBy(const std::string& outcome, int chosen) {
  SearchTrial trial = episode(SearchMode::real, 1, chosen, 23.4);
  trial.outcome = training::outcomeNamed(outcome);
  return trial;
}

TEST(SearchMode, ReadsItsOwnNames) {
  for (const SearchMode mode : {SearchMode::real, SearchMode::degraded, SearchMode::augmented})
    EXPECT_EQ(searchModeOf(name(mode)), mode);
  EXPECT_EQ(searchModeOf("Real"), std::nullopt);
  EXPECT_EQ(searchModeOf(""), std::nullopt);
}

TEST(SearchTrial, SaysHowItEnded) {
  EXPECT_EQ(summaryOf(endedBy("done", 1)),
            "Found: the probe stayed in the target's pit after 23 s.");
  EXPECT_EQ(summaryOf(endedBy("done", 2)),
            "Not found: the probe stayed in the pit of another element after 23 s.");
  EXPECT_EQ(summaryOf(endedBy("time", -1)), "The time was over before the probe stayed in a pit.");
  EXPECT_EQ(summaryOf(endedBy("aborted", -1)), "Aborted before the probe stayed in a pit.");
  EXPECT_EQ(summaryOf(endedBy("void", 1)), "Void: it does not count.");
  EXPECT_EQ(summaryOf(endedBy("done", -1)), "The probe stayed in no pit.");
  EXPECT_EQ(summaryOf(endedBy("", -1)), "The probe stayed in no pit.");
}

TEST(SearchTrial, OnlyAChoiceInTimeIsOne) {
  EXPECT_TRUE(chose(endedBy("done", 0)));
  EXPECT_FALSE(chose(endedBy("done", -1)));
  for (const char* outcome : {"time", "aborted", "void"})
    EXPECT_FALSE(chose(endedBy(outcome, 1))) << outcome;
}

TEST(SearchTally, GoesByBlockAndModeInTheOrderOfTheFirst) {
  std::vector<SearchTrial> trials = episodes(SearchMode::augmented, 2, 3) +
                                    episodes(SearchMode::real, 3, 3) +
                                    episodes(SearchMode::augmented, 1, 1);
  for (std::size_t i = 3; i < 6; ++i) trials[i].block = "baseline";
  const std::vector<SearchTally> tallies = talliesOf(trials);
  ASSERT_EQ(tallies.size(), 2u);
  EXPECT_EQ(tallies[0].mode, SearchMode::augmented);
  EXPECT_EQ(tallies[0].block, "");
  EXPECT_EQ(tallies[0].episodes, 4);
  EXPECT_EQ(tallies[0].found, 3);
  EXPECT_EQ(tallies[1].mode, SearchMode::real);
  EXPECT_EQ(tallies[1].block, "baseline");
  EXPECT_EQ(tallies[1].found, 3);
  EXPECT_TRUE(talliesOf({}).empty());
}

TEST(SearchTally, NothingChosenIsNotFoundAndVoidAndUnscoredAreLeftOut) {
  std::vector<SearchTrial> trials{episode(SearchMode::real, 0, 0), episode(SearchMode::real, 0, -1),
                                  episode(SearchMode::real, 0, 0), episode(SearchMode::real, 0, 0),
                                  episode(SearchMode::real, 2, 2)};
  trials[2].outcome = training::Outcome::voided;
  trials[3].role = training::Role::familiarisation;
  trials[4].outcome = training::Outcome::aborted;
  const std::vector<SearchTally> tallies = talliesOf(trials);
  ASSERT_EQ(tallies.size(), 1u);
  EXPECT_EQ(tallies[0].episodes, 3);
  EXPECT_EQ(tallies[0].chosen, 1);
  EXPECT_EQ(tallies[0].found, 1);
}

TEST(SearchTally, TheMedianIsOfTheChoices) {
  const std::vector<SearchTrial> three{
      episode(SearchMode::real, 0, 0, 30), episode(SearchMode::real, 0, 1, 10),
      episode(SearchMode::real, 0, 2, 14), episode(SearchMode::real, 0, -1, 180)};
  EXPECT_EQ(talliesOf(three).front().seconds_median, 14);
  EXPECT_EQ(talliesOf({three[0], three[1]}).front().seconds_median, 20);
  EXPECT_TRUE(std::isnan(talliesOf({three[3]}).front().seconds_median));
}

TEST(SearchTally, ItsIntervalIsWilsons) {
  const SearchTally tally = talliesOf(episodes(SearchMode::real, 7, 10)).front();
  const statistics::ShareInterval interval = statistics::wilson(7, 10);
  EXPECT_EQ(tally.found_share, 0.7);
  EXPECT_EQ(tally.found_low, interval.low);
  EXPECT_EQ(tally.found_high, interval.high);
  EXPECT_NEAR(interval.low, 0.3968, 5e-5);
  EXPECT_NEAR(interval.high, 0.8922, 5e-5);
}

}  // namespace
}  // namespace palpa::assess

#include "anatomy/base/nearest_word.h"

#include <gtest/gtest.h>

#include <vector>

namespace palpa {
namespace {

const std::vector<std::string> kCommands{"paracentesis", "palpation", "patient",
                                         "report",       "records",   "replay"};

TEST(NearestWord, IsFoundByALetterMoreLessOtherOrSwapped) {
  EXPECT_EQ(nearestWord("paracentsis", kCommands), "paracentesis");
  EXPECT_EQ(nearestWord("paracentesiss", kCommands), "paracentesis");
  EXPECT_EQ(nearestWord("repord", kCommands), "report");
  EXPECT_EQ(nearestWord("rpelay", kCommands), "replay");
  EXPECT_EQ(nearestWord("patient", kCommands), "patient");
}

TEST(NearestWord, OfAFieldTakesCapitalsAndStrokesLightly) {
  const std::vector<std::string> fields{"X_WB", "X_WD", "max-force", "time_limit_s"};
  EXPECT_EQ(nearestWord("x_wd", fields), "X_WD");
  EXPECT_EQ(nearestWord("max_force", fields), "max-force");
  EXPECT_EQ(nearestWord("Time-Limit-S", fields), "time_limit_s");
}

TEST(NearestWord, IsTheFirstOfEquallyNearOnes) {
  EXPECT_EQ(nearestWord("bat", std::vector<std::string>{"cat", "rat"}), "cat");
  EXPECT_EQ(nearestWord("raat", std::vector<std::string>{"chat", "rat"}), "rat");
}

TEST(NearestWord, IsProposedWhenEnoughOfItIsThere) {
  EXPECT_EQ(nearestWord("squeeze", kCommands), std::nullopt);
  EXPECT_EQ(nearestWord("xyz", kCommands), std::nullopt);
  EXPECT_EQ(nearestWord("y", std::vector<std::string>{"n"}), std::nullopt);
  EXPECT_EQ(nearestWord("", kCommands), std::nullopt);
  EXPECT_EQ(nearestWord("report", std::vector<std::string>{}), std::nullopt);
  EXPECT_EQ(nearestWord(std::string(100'000, 'a'), kCommands), std::nullopt);
}

TEST(NearestWord, IsTheOnlyOneThatBeginsSo) {
  EXPECT_EQ(nearestWord("para", kCommands), "paracentesis");
  EXPECT_EQ(nearestWord("pa", kCommands), std::nullopt);
  EXPECT_EQ(nearestWord("rep", kCommands), std::nullopt);
}

TEST(DidYouMean, EndsASentence) {
  EXPECT_EQ(didYouMean("repord", kCommands), " (did you mean \"report\"?)");
  EXPECT_EQ(didYouMean("--seeed", std::vector<std::string>{"--seed"}, ""),
            " (did you mean --seed?)");
  EXPECT_EQ(didYouMean("xyz", kCommands), "");
}

}  // namespace
}  // namespace palpa

#include "apps/console/blinding.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// What an educator hears who must not know the condition.
namespace palpa::console {
namespace {

using nlohmann::json;

/// What sessions tell, in one of two conditions: everything that could tell them apart does.
std::vector<std::string> logOf(bool augmented) {
  const double stronger = augmented ? 2 : 1;
  const std::string aid = augmented ? "augmented" : "plain";
  std::vector<json> entries{
      {{"kind", "hello"},
       {"uuid", "u"},
       {"task", "search_" + aid},
       {"trainee", "T017"},
       {"simulated", true},
       {"assessed", augmented},
       {"trials", 8}},
      {{"kind", "status"},
       {"state", "running"},
       {"trial", 3},
       {"trials", 8},
       {"role", aid},
       {"notice", aid + " now"},
       {"alarm", false},
       {"emergency_stop", false},
       {"phase", aid},
       {"depth", aid},
       {"force", stronger},
       {"touched", aid},
       {"elapsed_s", 12.5},
       {"t_s", 40.1}},
      {{"kind", "status"},
       {"state", "running"},
       {"trial", 3},
       {"trials", 8},
       {"role", aid},
       {"notice", "Force was taken away"},
       {"alarm", true},
       {"emergency_stop", true},
       {"force", stronger},
       {"elapsed_s", 13.5},
       {"t_s", 41.1}},
      {{"kind", "curve"},
       {"trial", 3},
       {"t_s", {1, 2}},
       {"force_N", {stronger, stronger}},
       {"depth_mm", {1, stronger}}},
      {{"kind", "trial"}, {"t_s", 28}, {"trial", 3}, {"role", aid}},
      {{"kind", "near"}, {"t_s", 30}, {"trial", 3}, {"text", aid}, {"tone", "bad"}},
      {{"kind", "trial_end"},
       {"t_s", 50},
       {"trial", 3},
       {"reason", aid},
       {"outcome", augmented ? "success" : "mistaken"}},
      {{"kind", aid}, {"t_s", 50}},
      {{"t_s", 50}, {"mode", aid}}};
  for (const char* of :
       {"start", "pause", "resume", "ready", "case", "phase", "puncture", "withdrawn", "wall",
        "vein", "touched", "mark", "grade", "let_go", "thing", "answer", "picture"})
    entries.push_back({{"kind", "event"},
                       {"event", of},
                       {"t_s", 31},
                       {"trial", 3},
                       {"text", R"({"mode":")" + aid + "\"}"},
                       {"value", stronger},
                       {"tone", augmented ? "good" : "bad"}});
  std::vector<std::string> log;
  for (const json& entry : entries) log.push_back(entry.dump());
  log.push_back("{ no json " + aid);
  return log;
}

TEST(Blinded, TwoConditionsAreTheSameByteForByte) {
  const std::vector<std::string> one = logOf(false), other = logOf(true);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_NE(one[i], other[i]) << "the test tells them apart";
    EXPECT_EQ(blinded(one[i]), blinded(other[i]));
    EXPECT_EQ(blinded(one[i]).find("augmented"), std::string::npos);
  }
}

TEST(Blinded, HowItStandsStopsAndNotesAreHeard) {
  const std::vector<std::string> log = logOf(true);
  const json status = json::parse(blinded(log[1])), alarm = json::parse(blinded(log[2]));
  EXPECT_EQ(status, (json{{"kind", "status"},
                          {"state", "running"},
                          {"trial", 3},
                          {"trials", 8},
                          {"notice", ""},
                          {"alarm", false},
                          {"emergency_stop", false},
                          {"elapsed_s", 12.5},
                          {"t_s", 40.1}}));
  EXPECT_EQ(alarm["notice"], "") << "it may be of what is touched";
  EXPECT_EQ(alarm["emergency_stop"], true);
  const auto heard = [](const json& entry) { return json::parse(blinded(entry.dump())); };
  const json note = heard({{"kind", "event"},
                           {"event", "note"},
                           {"t_s", 5},
                           {"trial", 1},
                           {"text", "note: a phone rang"},
                           {"about_s", 4.2},
                           {"tone", "note"}});
  EXPECT_EQ(note["text"], "note: a phone rang");
  EXPECT_EQ(note["about_s"], 4.2);
  EXPECT_EQ(heard({{"kind", "event"},
                   {"event", "emergency_stop"},
                   {"t_s", 5},
                   {"trial", 1},
                   {"text", "The space bar"}})["text"],
            "The space bar");
  const json out = heard({{"kind", "trial_end"},
                          {"t_s", 50},
                          {"trial", 3},
                          {"outcome", "void"},
                          {"reason", "The bed moved"}});
  EXPECT_EQ(out["outcome"], "void");
  EXPECT_EQ(out["reason"], "The bed moved");
  EXPECT_EQ(heard({{"kind", "refused"}, {"text", "no"}})["text"], "no");
}

/// Numbers of entries are how pages read on: each stays one.
TEST(Blinded, WhatMayNotBeHeardIsStillAnEntry) {
  for (const std::string text : {"", "[]", "null", "7", "{}", "\xff", "{\"kind\":3}"})
    EXPECT_EQ(blinded(text), R"({"kind":"curve"})") << text;
}

}  // namespace
}  // namespace palpa::console

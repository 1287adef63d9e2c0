#include "apps/console/session_results.h"

#include <gtest/gtest.h>

#include "apps/record/session_file.h"
#include "tests/support/scratch_folder.h"

namespace palpa::console {
namespace {

using nlohmann::json;

struct Ended {
  const char *outcome, *scores;
  const char* role = "scored";
};

/// What the console says of a session whose trials ended so.
json trialsOf(const std::vector<Ended>& trials, bool blind = false) {
  const test::ScratchFolder place("results");
  record::SessionInfo info;
  info.uuid = "u";
  info.started_utc = "2026-12-01T10:00:00Z";
  info.command = "palpate";
  info.session_json = info.task_json = info.station_json = "{}";
  {
    record::SessionWriter writer(place / "session.palpa", info);
    int number = 0;
    for (const Ended& trial : trials) {
      writer.beginTrial({++number, number * 1'000'000'000LL, 7, trial.role, true, 0});
      writer.endTrial(
          {number, number * 1'000'000'000LL + 500'000'000, trial.outcome, "", trial.scores});
    }
    writer.close();
  }
  return trialsIn(place / "session.palpa", blind);
}

TEST(SessionResults, SayWhetherATrialThatIsDoneReachedItsGoal) {
  const json trials = trialsOf({{"done", R"({"FOUND":2,"MISSED":1,"AT_STANDARD":0})"},
                                {"done", R"({"RIGHT":1,"FOUND":1})"},
                                {"done", R"({"FOUND":0})"},
                                {"success", R"({"SUCCESS":1,"TOTAL":120.5})"},
                                {"done", ""}});
  EXPECT_EQ(trials[0]["goal"]["word"], "below the standard") << "two lumps found, one missed";
  EXPECT_EQ(trials[1]["goal"]["word"], "right");
  EXPECT_EQ(trials[2]["goal"]["word"], "not found");
  EXPECT_EQ(trials[3]["goal"]["reached"], true);
  EXPECT_EQ(trials[3]["total"], 120.5);
  EXPECT_FALSE(trials[4].contains("goal"));
}

TEST(SessionResults, CountWhatCounts) {
  const json outcome = outcomeOf(trialsOf({{"done", R"({"AT_STANDARD":1})"},
                                           {"done", R"({"AT_STANDARD":0})"},
                                           {"void", ""},
                                           {"done", R"({"AT_STANDARD":1})", "familiarisation"}}));
  EXPECT_EQ(outcome["counting"], 2);
  EXPECT_EQ(outcome["succeeded"], 1);
  EXPECT_EQ(outcome["word"], "at the standard");
  EXPECT_FALSE(outcome.contains("total"));
  EXPECT_EQ(outcomeOf(trialsOf({{"done", ""}}))["done"], 1) << "of a task whose goal is not known";
}

TEST(SessionResults, OfABlindStudyTellNoGoal) {
  const json trials = trialsOf({{"done", R"({"RIGHT":1,"TOTAL":3})"}}, true);
  EXPECT_EQ(trials[0]["outcome"], "recorded");
  for (const char* figure : {"goal", "total", "summary", "role"})
    EXPECT_FALSE(trials[0].contains(figure)) << figure;
}

}  // namespace
}  // namespace palpa::console

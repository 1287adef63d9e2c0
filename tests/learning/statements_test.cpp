#include <gtest/gtest.h>

#include "apps/learning/cmi5_statements.h"
#include "apps/learning/launches.h"

namespace palpa::learning {
namespace {

using nlohmann::json;

Cmi5Facts facts(std::optional<double> mastery = 0.8) {
  return {.launch = "0a6b1f9e-38c2-4f14-8a55-0d5b7a1c2e3f",
          .actor = {{"objectType", "Agent"},
                    {"account", {{"homePage", "https://lms.example"}, {"name", "17"}}}},
          .context = {{"contextActivities", {{"grouping", {{{"id", "https://lms.example/au"}}}}}},
                      {"extensions", {{kSessionId, "session-1"}}}},
          .activity = "https://lms.example/activities/4",
          .registration = "5f2d6f8e-6e6d-4d3f-9a3c-2b1f0c9d8e7a",
          .mastery = mastery,
          .began_utc = "2026-03-01T12:30:00.250Z"};
}

std::vector<std::string> verbsOf(const std::vector<json>& statements) {
  std::vector<std::string> verbs;
  for (const json& one : statements) {
    const std::string id = one.at("verb").at("id");
    verbs.push_back(id.substr(id.rfind('/') + 1));
  }
  return verbs;
}

using Verbs = std::vector<std::string>;

LaunchResult held(double scaled) {
  return {.completed = true, .scaled = scaled, .simulated = false, .length_ms = 31'500};
}

TEST(Cmi5Statements, EndInOrderAndByTheMasteryScore) {
  EXPECT_EQ(verbsOf(statementsAtEnd(facts(), held(0.8), {})),
            (Verbs{"completed", "passed", "terminated"}));
  EXPECT_EQ(verbsOf(statementsAtEnd(facts(), held(0.79), {})),
            (Verbs{"completed", "failed", "terminated"}));
  EXPECT_EQ(verbsOf(statementsAtEnd(facts(std::nullopt), held(0.99), {})),
            (Verbs{"completed", "failed", "terminated"}))
      << "without one, all trials are to be at the standard";
}

TEST(Cmi5Statements, OfASecondSessionOfARegistrationSayNothingTwice) {
  EXPECT_EQ(verbsOf(statementsAtEnd(facts(), held(1), {.completed = true, .passed = false})),
            (Verbs{"passed", "terminated"}));
  EXPECT_EQ(verbsOf(statementsAtEnd(facts(), held(0), {.completed = true, .passed = true})),
            (Verbs{"terminated"}))
      << "nobody fails who has passed";
}

TEST(Cmi5Statements, OfBrowseAndReviewSettleNothing) {
  Cmi5Facts browsed = facts();
  browsed.counts = false;
  EXPECT_EQ(verbsOf(statementsAtEnd(browsed, held(1), {})), (Verbs{"terminated"}));
}

TEST(Cmi5Statements, OfASessionThatWasLeftOnlyEndIt) {
  EXPECT_EQ(verbsOf(statementsAtEnd(facts(), {.length_ms = 1'000}, {})), (Verbs{"terminated"}));
}

TEST(Cmi5Statements, KeepTheTemplateAndAddWhatTheyMustSay) {
  const std::vector<json> all = statementsAtEnd(facts(), held(1), {});
  const json& passed = all[1];
  const json& context = passed.at("context");
  EXPECT_EQ(context.at("contextActivities").at("grouping"),
            facts().context.at("contextActivities").at("grouping"));
  EXPECT_EQ(context.at("extensions").at(kSessionId), "session-1");
  EXPECT_EQ(context.at("extensions").at(kMasteryScore), 0.8);
  EXPECT_EQ(context.at("registration"), facts().registration);
  EXPECT_EQ(context.at("contextActivities").at("category").size(), 2u);
  EXPECT_EQ(passed.at("result").at("score").at("scaled"), 1);
  EXPECT_EQ(passed.at("result").at("duration"), "PT31.50S");
  EXPECT_EQ(passed.at("timestamp"), "2026-03-01T12:30:31.751Z");
  EXPECT_EQ(statementsAtEnd(facts(), held(1), {}), all) << "the same facts, the same ids";
  EXPECT_EQ(initialized(facts()).at("context").at("contextActivities").at("category").size(), 1u);
}

TEST(Cmi5Statements, FactsComeBackAsTheyWereKept) {
  EXPECT_EQ(toJson(cmi5FactsIn(toJson(facts()))), toJson(facts()));
  EXPECT_EQ(toJson(cmi5FactsIn(toJson(facts(std::nullopt)))), toJson(facts(std::nullopt)));
}

TEST(Launch, OfLtiTellsOneScoreWhereThePlatformKeepsOne) {
  Launch launch;
  launch.kind = PlatformKind::lti;
  launch.person = "17";
  launch.line_item = "https://lms.example/items/7";
  conclude(launch, held(0.5), {}, "2026-03-01T12:31:00.000Z");
  ASSERT_EQ(launch.due.size(), 1u);
  EXPECT_EQ(launch.due[0].at("scoreGiven"), 50);
  EXPECT_EQ(launch.due[0].at("activityProgress"), "Completed");
  EXPECT_EQ(launch.result, "50 % of the trials reached the task's goal.");
  Launch without = launch;
  without.due.clear();
  without.line_item.clear();
  conclude(without, held(0.5), {}, "2026-03-01T12:31:00.000Z");
  EXPECT_TRUE(without.isDone());
}

}  // namespace
}  // namespace palpa::learning

#include "apps/link/statement.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/link/trials.h"
#include "tests/link/xapi_rules.h"

namespace palpa::link_test {
namespace {

using nlohmann::json;

constexpr char kHome[] = "https://centre.example/palpa";

json statement() { return link::statementOf(sessionOf("T017", 1), trialOf(3), kHome); }

TEST(Statement, FollowsTheRules) {
  EXPECT_EQ(whyNoStatement(statement()), "");
  EXPECT_EQ(whyNoStatement(link::voidingOf(statement()["id"])), "");
  record::StoredSession odd = sessionOf("T017", 1, true);
  odd.task = "train ü/?# x";
  odd.study = "my study";
  record::StoredTrial search = trialOf(1);
  search.metrics = {{"sensitivity_pct", 50}};
  search.outcome = "aborted";
  EXPECT_EQ(whyNoStatement(link::statementOf(odd, search, kHome)), "");
}

TEST(Statement, SaysWhatHappened) {
  const json s = statement();
  EXPECT_EQ(s["actor"]["account"]["name"], "T017");
  EXPECT_EQ(s["actor"]["account"]["homePage"], kHome);
  EXPECT_EQ(s["verb"]["id"], "http://adlnet.gov/expapi/verbs/passed");
  EXPECT_EQ(s["result"]["duration"], "PT31.52S");
  EXPECT_EQ(s["result"]["score"], (json{{"raw", 913.24}, {"min", 0}}));
  EXPECT_EQ(s["result"]["extensions"]["https://palpa.invalid/xapi/figures/total"], 913.24);
  EXPECT_FALSE(s["result"]["extensions"].contains(
      "https://palpa.invalid/xapi/figures/closest-artery-mm"));  // does not apply
  EXPECT_EQ(s["context"]["registration"], uuidOf(1));
  EXPECT_EQ(s["context"]["extensions"]["https://palpa.invalid/xapi/extensions/simulated"], false);
  EXPECT_EQ(s["timestamp"], "2026-03-01T10:05:31.524Z");  // the end of the third trial
  EXPECT_EQ(s.dump().find("/home/"), std::string::npos);  // no place of this computer
}

TEST(Statement, VerbAndScoreFollowTheTrial) {
  const auto verb = [](const char* role, const char* outcome, bool success) {
    record::StoredTrial t = trialOf(1);
    t.role = role, t.outcome = outcome, t.success = success;
    const std::string id = link::statementOf(sessionOf("A", 1), t, kHome)["verb"]["id"];
    return id.substr(id.rfind('/') + 1);
  };
  EXPECT_EQ(verb("scored", "time", false), "failed");
  EXPECT_EQ(verb("scored", "aborted", false), "terminated");
  EXPECT_EQ(verb("familiarisation", "success", true), "completed");
  record::StoredTrial palpation = trialOf(1);
  palpation.metrics = {{"sensitivity_pct", 50}};
  EXPECT_EQ(link::statementOf(sessionOf("A", 1), palpation, kHome)["result"]["score"],
            (json{{"raw", 50.0}, {"min", 0}, {"max", 100}, {"scaled", 0.5}}));
}

TEST(Statement, WhatWasSimulatedIsAnotherActivityAndSaysSo) {
  const json real = statement(),
             simulated = link::statementOf(sessionOf("T017", 1, true), trialOf(3), kHome);
  EXPECT_NE(real["object"]["id"], simulated["object"]["id"]);
  EXPECT_EQ(simulated["object"]["definition"]["name"]["en"], "paracentesis (simulated)");
  EXPECT_EQ(simulated["context"]["extensions"]["https://palpa.invalid/xapi/extensions/simulated"],
            true);
}

TEST(Statement, IsTheSameForTheSameTrialAndNoOther) {
  EXPECT_EQ(statement(), statement());
  std::set<std::string> ids;
  for (int session = 1; session <= 5; ++session)
    for (int trial = 1; trial <= 20; ++trial) ids.insert(link::statementId(uuidOf(session), trial));
  EXPECT_EQ(ids.size(), 100u);
  EXPECT_EQ(link::voidingOf(statement()["id"]), link::voidingOf(statement()["id"]));
  record::StoredSession odd = sessionOf("A", 1);
  odd.uuid = "u1";
  EXPECT_THROW(link::statementOf(odd, trialOf(1), kHome), Error);
}

TEST(Statement, IsRecognisedInWhatAStoreMadeOfIt) {
  const json told = statement();
  json there = told;
  there["stored"] = "2026-03-01T12:00:00.000Z";
  there["authority"] = {{"mbox", "mailto:a@b"}};
  there["timestamp"] = "2026-03-01T10:05:31.524000+00:00";
  there["object"]["definition"]["name"]["de"] = "Parazentese";
  EXPECT_TRUE(link::saysTheSame(told, there));
  for (const char* at : {"/actor/account/name", "/verb/id", "/result/score/raw",
                         "/context/registration", "/timestamp"}) {
    json other = there;
    other[json::json_pointer(at)] = "other";
    EXPECT_FALSE(link::saysTheSame(told, other)) << at;
  }
  EXPECT_FALSE(link::saysTheSame(told, nullptr));
}

TEST(Statement, OfASessionWithoutATime) {
  record::StoredSession lost = sessionOf("A", 1);
  lost.started_utc = "";
  EXPECT_EQ(whyNoStatement(link::statementOf(lost, trialOf(1), kHome)),
            "");  // the store then puts its own
}

/// The rules must be able to say no.
TEST(Rules, NameWhatIsWrong) {
  const auto broken = [](const char* at, const json& value) {
    json s = statement();
    s[json::json_pointer(at)] = value;
    return whyNoStatement(s);
  };
  for (const auto& [at, value] : std::vector<std::pair<const char*, json>>{
           {"/id", "x"},
           {"/actor/mbox", "mailto:a@b"},
           {"/actor/account/homePage", "no iri"},
           {"/actor/account/name", ""},
           {"/verb/id", "passed"},
           {"/verb/display", "passed"},
           {"/object/id", "a b:c"},
           {"/object/extra", 1},
           {"/result/duration", "31 s"},
           {"/result/duration", "P"},
           {"/result/success", "yes"},
           {"/result/success", nullptr},
           {"/result/score/scaled", 1.5},
           {"/result/score/raw", -1},
           {"/result/score/max", 1},
           {"/result/extensions", {{"no iri", 1}}},
           {"/context/registration", "u1"},
           {"/context/contextActivities", {{"grouping", {{"id", "x:y"}}}}},
           {"/timestamp", "2026-03-01T10:00:00"},
           {"/timestamp", "2026-03-01T10:00:00-00:00"},
           {"/verb/id", "http://adlnet.gov/expapi/verbs/voided"}})
    EXPECT_NE(broken(at, value), "") << at << " " << value;
  json s = statement();
  s["actor"].erase("account");
  EXPECT_EQ(whyNoStatement(s), "actor has 0 identifiers instead of one");
  for (const char* good : {"P3Y6M4DT12H30M5S", "PT0.05S", "P4W", "PT1H"})
    EXPECT_TRUE(isDuration(good)) << good;
  for (const char* bad : {"PT", "P", "PT1S2H", "1S", "P4W1D"}) EXPECT_FALSE(isDuration(bad)) << bad;
}

}  // namespace
}  // namespace palpa::link_test

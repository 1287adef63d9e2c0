#include "apps/study/protocol.h"
#include "apps/training/engine.h"
#include "apps/training/trial_words.h"

#include "small_protocol.h"

namespace palpa::study {
namespace {

using nlohmann::json;

TEST(Protocol, IsReadAsWritten) {
  const auto file = written(smallProtocol());
  const Protocol p = readProtocol(file);
  EXPECT_EQ(p.id, "small");
  EXPECT_EQ(p.sha256.size(), 64u);
  ASSERT_EQ(p.sessions.size(), 2u);
  const Block& train = p.block(2);
  EXPECT_EQ(train.name, "train");
  EXPECT_EQ(train.trials, 5);
  EXPECT_EQ(train.condition, "");
  EXPECT_EQ(train.rest_after, 2);
  EXPECT_EQ(train.rest_s, 100);
  EXPECT_EQ(train.engine, training::Engine::needle);
  EXPECT_EQ(train.task, file.parent_path() / "task.json");
  EXPECT_EQ(p.block(1).role, training::Role::familiarisation);
  EXPECT_EQ(p.block(3).condition, "plain");
  EXPECT_EQ(p.sessionOf(2), 1);
  EXPECT_EQ(p.sessionOf(3), 2);
  EXPECT_EQ(p.sessions[1].days_after, 2);
  EXPECT_EQ(p.sessions[1].questionnaire->items.size(), 2u);
  EXPECT_FALSE(p.condition("B")->shows.force_feedback);
  EXPECT_FALSE(p.condition("B")->shows.navigation);  // always so
  EXPECT_TRUE(p.condition("plain")->shows.force_feedback);
  EXPECT_TRUE(p.excludes_experts);
  EXPECT_FALSE(p.blind());
  EXPECT_THROW(p.block(4), Error);
}

/// Whoever does not feel the force must not read it off the screen, nor the others see more.
TEST(Protocol, ConditionsDifferInWhatTheySayAlone) {
  for (const StudyCondition& c : readProtocol(written(smallProtocol())).conditions) {
    EXPECT_TRUE(c.shows.hide_forces) << c.name;
    EXPECT_FALSE(c.shows.presentation) << c.name;
  }
  json all_feel = smallProtocol();
  all_feel["conditions"][1]["sets"] = {{"augment", true}};
  for (const StudyCondition& c : readProtocol(written(all_feel)).conditions)
    EXPECT_FALSE(c.shows.hide_forces) << c.name;
}

TEST(Protocol, APresentationIsNamedOrAFileBesideIt) {
  json named = smallProtocol();
  named["conditions"][1]["sets"]["presentation"] = "substitution";
  const Protocol p = readProtocol(written(named));
  EXPECT_EQ(p.condition("B")->shows.presentation.value().name, "substitution");
  EXPECT_FALSE(p.condition("B")->shows.hide_forces);
  named["conditions"][1]["sets"]["presentation"] = "substituton";
  const auto file = written(named);
  const std::string said = complaintOf([&] { readProtocol(file); });
  EXPECT_NE(said.find("substitution"), std::string::npos) << said;
  EXPECT_NE(said.find("protocol.json"), std::string::npos) << said;
}

TEST(Protocol, TheFormerNamesOfFieldsAreRead) {
  json former = smallProtocol();
  former["bars_experts"] = false;
  former["barred"] = json::array({"T007"});
  const Protocol p = readProtocol(written(former));
  EXPECT_FALSE(p.excludes_experts);
  EXPECT_EQ(p.excluded, std::vector<std::string>{"T007"});
}

TEST(Protocol, TheShippedOnesAreTheSources) {
  const std::filesystem::path shipped = PALPA_SOURCE_DIR "/assets/protocols";
  const Protocol pilot = readProtocol(shipped / "paracentesis_pilot.json");
  EXPECT_EQ(pilot.groups.size(), 2u);
  EXPECT_EQ(pilot.block(1).role, training::Role::familiarisation);
  EXPECT_EQ(pilot.block(1).trials, 1);
  EXPECT_EQ(pilot.block(2).trials, 10);
  EXPECT_TRUE(pilot.condition("FF")->shows.force_feedback);
  EXPECT_FALSE(pilot.condition("NO")->shows.force_feedback);
  for (const StudyCondition& c : pilot.conditions)
    EXPECT_FALSE(c.shows.skin_deflection || c.shows.augment || c.shows.guide) << c.name;
  for (const StudyCondition& c : pilot.conditions)
    EXPECT_EQ(c.shows.presentation.value().name, "pilot") << c.name;
  EXPECT_TRUE(pilot.sessions.at(0).questionnaire);

  const Protocol search = readProtocol(shipped / "search_study.json");
  ASSERT_EQ(search.sessions.size(), 2u);
  EXPECT_GE(search.sessions[1].days_after, 1);
  EXPECT_EQ(search.block(1).role, training::Role::familiarisation);
  EXPECT_EQ(search.condition(search.block(1).condition)->shows.mode, "real");
  const int trials[] = {60, 40, 60};
  for (int step = 2; step <= 4; ++step) {
    EXPECT_EQ(search.block(step).role, training::Role::scored);
    EXPECT_EQ(search.block(step).trials, trials[step - 2]);
    EXPECT_EQ(search.block(step).rest_after, 20);
    EXPECT_EQ(search.block(step).condition.empty(), step == 3);  // drawn for the training alone
  }
  EXPECT_EQ(search.condition(search.block(2).condition)->shows.mode, "real");
  EXPECT_EQ(search.condition("augmented")->shows.mode, "augmented");
}

struct Damage {
  const char* name;
  std::function<void(json&)> change;
  const char* words;
};

class WrongProtocol : public testing::TestWithParam<Damage> {};

TEST_P(WrongProtocol, IsRefusedWithFileAndField) {
  json protocol = smallProtocol();
  GetParam().change(protocol);
  const auto file = written(protocol);
  const std::string complaint = complaintOf([&] { readProtocol(file); });
  EXPECT_NE(complaint.find(file.parent_path().string()), std::string::npos) << complaint;
  EXPECT_NE(complaint.find(GetParam().words), std::string::npos) << complaint;
  EXPECT_EQ(complaint.find('\n'), std::string::npos) << complaint;
}

json& block(json& p, int i) { return p["sessions"][0]["blocks"][i]; }

INSTANTIATE_TEST_SUITE_P(
    Each, WrongProtocol,
    testing::Values(
        Damage{"Version", [](json& p) { p["version"] = 2; }, "\"version\" is newer"},
        Damage{"NoId", [](json& p) { p.erase("id"); }, "\"id\" is missing"},
        Damage{"IdOfWords", [](json& p) { p["id"] = "a study"; }, "\"id\" is \"a study\""},
        Damage{"NoGroup", [](json& p) { p["groups"] = json::array(); }, "\"groups\" must be"},
        Damage{"GroupTwice", [](json& p) { p["groups"][1]["name"] = "novice"; },
               "which another one has, too"},
        Damage{"ConditionTwice", [](json& p) { p["conditions"][2]["name"] = "A"; },
               "which another one has, too"},
        Damage{"UnknownCondition", [](json& p) { block(p, 0)["condition"] = "C"; },
               "not one of the protocol's conditions"},
        Damage{"UnknownDrawn", [](json& p) { p["allocation"]["conditions"][1] = "C"; },
               "not one of the protocol's conditions"},
        Damage{"DrawnTwice", [](json& p) { p["allocation"]["conditions"][1] = "A"; },
               "\"A\" twice"},
        Damage{"OneDrawn", [](json& p) { p["allocation"]["conditions"] = json::array({"A"}); },
               "at least two"},
        Damage{"Unbalanced", [](json& p) { p["allocation"]["block"] = 3; },
               "multiple of the number of conditions"},
        Damage{"NoAllocation", [](json& p) { p.erase("allocation"); }, "no \"allocation\""},
        Damage{"NothingDrawn", [](json& p) { block(p, 1)["condition"] = "plain"; },
               "is used by no block"},
        Damage{"NotUsed",
               [](json& p) {
                 p["conditions"].push_back({{"name", "D"}, {"means", "idle"}});
               },
               "\"D\", which no block"},
        Damage{"Misspelt",
               [](json& p) {
                 p["conditions"][0]["sets"] = {{"force_feedbak", true}};
               },
               "force_feedbak"},
        Damage{"OnInWords",
               [](json& p) {
                 p["conditions"][0]["sets"] = {{"force_feedback", "on"}};
               },
               "must be true or false"},
        Damage{"UnknownMode",
               [](json& p) {
                 p["conditions"][0]["sets"] = {{"mode", "soft"}};
               },
               "must be one of augmented, degraded, real"},
        Damage{"NamedDrawn", [](json& p) { p["conditions"][0]["name"] = "drawn"; },
               "which means the condition"},
        Damage{"NoTrials", [](json& p) { block(p, 1)["trials"] = 0; },
               "\"trials\" is 0, outside 1"},
        Damage{"HalfATrial", [](json& p) { block(p, 1)["trials"] = 1.5; }, "whole number"},
        Damage{"NegativeRest", [](json& p) { block(p, 1)["rest_s"] = -1; }, "\"rest_s\" is -1"},
        Damage{"RestOfNoTime", [](json& p) { block(p, 1).erase("rest_s"); }, "needs rest_s"},
        Damage{"UnknownRole", [](json& p) { block(p, 1)["role"] = "exam"; },
               "must be one of familiarisation, scored"},
        Damage{"NegativeDays", [](json& p) { p["sessions"][1]["days_after"] = -1; },
               "\"days_after\" is -1"},
        Damage{"NoBlock", [](json& p) { p["sessions"][1]["blocks"] = json::array(); },
               "\"blocks\" must be"},
        Damage{"NoSession", [](json& p) { p.erase("sessions"); }, "\"sessions\" must be"},
        Damage{"BlindToWhom", [](json& p) { p["blind"] = json::array({"everybody"}); },
               "must be one of educator, trainee"},
        Damage{"ExcludedOne", [](json& p) { p["excluded"] = json::array({7}); },
               "must be a list of texts"},
        Damage{"NoTask", [](json& p) { block(p, 1)["task"] = "none.json"; }, "cannot be read"}),
    [](const auto& p) { return std::string(p.param.name); });

TEST(Protocol, ATaskOfAnUnknownEngineIsRefused) {
  const auto file = written(smallProtocol());
  std::ofstream(file.parent_path() / "task.json") << R"({"version": 1, "engine": "drill"})";
  EXPECT_NE(complaintOf([&] { readProtocol(file); }).find("\"drill\""), std::string::npos);
}

TEST(Protocol, TheLongestTimeIsToldAndBounded) {
  const auto slow = [](const json& protocol) {
    auto file = written(protocol);
    std::ofstream(file.parent_path() / "task.json")
        << R"({"version": 1, "engine": "needle", "end": {"time_limit_s": 3600}})";
    return file;
  };
  const Protocol p = readProtocol(slow(smallProtocol()));
  EXPECT_EQ(longestTime_s(p.block(2)), 5 * 3600 + 3 * 100);  // rests after 2 and 4, and at the end
  EXPECT_TRUE(longestTimeInWords(p).starts_with("at most ")) << longestTimeInWords(p);
  EXPECT_TRUE(longestTimeInWords(p).ends_with(" min")) << longestTimeInWords(p);
  json endless = smallProtocol();
  block(endless, 1)["trials"] = 1000;
  const auto file = slow(endless);
  const std::string said = complaintOf([&] { readProtocol(file); });
  EXPECT_NE(said.find("may take up to 10"), std::string::npos) << said;
  EXPECT_NE(said.find("at most 200 h"), std::string::npos) << said;
}

TEST(Protocol, FieldsOfAWrongKindAreNamedNotBelieved) {
  const json good = smallProtocol();
  const json flat = good.flatten();
  for (const auto& [pointer, value] : flat.items())
    for (const json& wrong :
         {json(nullptr), json::array({1, 2}), json(std::string(3, 'x')), json(-1e300)}) {
      json changed = good;
      changed.at(json::json_pointer(pointer)) = wrong;
      const auto file = written(changed);
      try {
        readProtocol(file);  // a text in place of a text may well be one
      } catch (const UsageError& e) {
        EXPECT_NE(std::string(e.what()).find(file.parent_path().string()), std::string::npos)
            << pointer << ": " << e.what();
      }
    }
}

}  // namespace
}  // namespace palpa::study

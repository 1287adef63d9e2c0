#include "apps/study/learning.h"

#include <cmath>

#include "apps/twin/learning_hand.h"
#include "small_protocol.h"

namespace palpa::study {
namespace {

using nlohmann::json;

json learnersJson() {
  const auto group = [](const char* name) {
    return json{{"name", name},           {"subjects", 3},    {"start", 0.1},
                {"start_sd", 0.0},        {"asymptote", 0.9}, {"asymptote_sd", 0.0},
                {"rate_per_trial", 0.25}, {"rate_sd", 0.0}};
  };
  return {{"version", 1},
          {"id", "some"},
          {"title", "Some"},
          {"planted", "something"},
          {"engine", "needle"},
          {"from", "a.json"},
          {"to", "b.json"},
          {"groups", {group("novice"), group("experienced")}},
          {"conditions",
           {{{"name", "A"}, {"rate_times", 2}},
            {{"name", "B"}, {"rate_times", 0}},
            {{"name", "plain"}, {"rate_times", 1}}}}};
}

Learners read(const json& learners) {
  const auto protocol = written(smallProtocol());
  const auto file = protocol.parent_path() / "learners.json";
  std::ofstream(file) << learners.dump();
  return readLearners(file, readProtocol(protocol));
}

TEST(Learning, IsTheCurveThatIsWritten) {
  const Learners learners = read(learnersJson());
  VirtualTrainee trainee(learners, "novice", 1);
  EXPECT_DOUBLE_EQ(trainee.level(), 0.1);
  trainee.practised("A");  // twice as much
  EXPECT_DOUBLE_EQ(trainee.level(), 0.9 - 0.8 * std::exp(-0.5));
  trainee.practised("B");  // nothing
  EXPECT_DOUBLE_EQ(trainee.level(), 0.9 - 0.8 * std::exp(-0.5));
  trainee.practised("plain");
  EXPECT_DOUBLE_EQ(trainee.level(), 0.9 - 0.8 * std::exp(-0.75));
}

/// Means and spreads of 4,000 people are those of the file: within 4 standard errors.
TEST(Learning, PeopleDiffer) {
  json text = learnersJson();
  text["groups"][0]["start"] = 0.5;
  text["groups"][0]["start_sd"] = 0.1;
  const Learners learners = read(text);
  double sum = 0, squares = 0;
  constexpr int kPeople = 4000;
  for (int i = 1; i <= kPeople; ++i) {
    const double level = VirtualTrainee(learners, "novice", static_cast<std::uint64_t>(i)).level();
    sum += level;
    squares += level * level;
    EXPECT_EQ(level, VirtualTrainee(learners, "novice", static_cast<std::uint64_t>(i)).level());
  }
  const double mean = sum / kPeople, sd = std::sqrt(squares / kPeople - mean * mean);
  EXPECT_NEAR(mean, 0.5, 4 * 0.1 / std::sqrt(kPeople));
  EXPECT_NEAR(sd, 0.1, 4 * 0.1 / std::sqrt(2.0 * kPeople));
}

TEST(Learning, StaysBetweenTheTwoOperators) {
  json text = learnersJson();
  text["groups"][0]["start_sd"] = text["groups"][0]["asymptote_sd"] = 1;
  const Learners learners = read(text);
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    VirtualTrainee trainee(learners, "novice", seed);
    for (int i = 0; i < 20; ++i, trainee.practised("A")) {
      EXPECT_GE(trainee.level(), 0);
      EXPECT_LE(trainee.level(), 1);
    }
  }
}

TEST(Learning, SaysWhatIsWrong) {
  const auto complaint = [](const std::function<void(json&)>& change) {
    json text = learnersJson();
    change(text);
    return complaintOf([&] { read(text); });
  };
  const auto has = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos && text.find("learners.json") != std::string::npos;
  };
  EXPECT_TRUE(has(complaint([](json& l) { l["version"] = 2; }), "newer"));
  EXPECT_TRUE(has(complaint([](json& l) { l["engine"] = "squeeze"; }), "needle and search"));
  EXPECT_TRUE(
      has(complaint([](json& l) { l["engine"] = "search"; }), "of the protocol is of \"needle\""));
  EXPECT_TRUE(has(complaint([](json& l) { l["groups"].erase(1); }), "lacks \"experienced\""));
  EXPECT_TRUE(
      has(complaint([](json& l) { l["groups"][1]["name"] = "masters"; }), "\"experienced\""));
  EXPECT_TRUE(has(complaint([](json& l) {
                    l["conditions"].push_back({{"name", "C"}, {"rate_times", 1}});
                  }),
                  "\"C\", which is not a condition"));
  EXPECT_TRUE(has(complaint([](json& l) { l["groups"][0]["start"] = 1.5; }), "\"start\" is 1.5"));
  EXPECT_TRUE(has(complaint([](json& l) { l["groups"][0]["subjects"] = 0; }), "\"subjects\" is 0"));
  EXPECT_TRUE(has(complaint([](json& l) { l["groups"][0].erase("rate_per_trial"); }),
                  "\"rate_per_trial\" is missing"));
}

TEST(Learning, TheShippedLearnersFitTheirProtocols) {
  const std::filesystem::path shipped = PALPA_SOURCE_DIR "/assets/protocols";
  const Protocol pilot = readProtocol(shipped / "paracentesis_pilot.json");
  const Learners planted = readLearners(shipped / "learners/paracentesis_learners.json", pilot);
  EXPECT_LT(planted.groups.at("novice").start, planted.groups.at("experienced").start);
  EXPECT_GT(planted.rate_times.at("FF"), planted.rate_times.at("NO"));
  EXPECT_EQ(planted.groups.at("novice").subjects, 10);
  const Learners nothing = readLearners(shipped / "learners/paracentesis_no_effect.json", pilot);
  EXPECT_EQ(nothing.groups.at("novice").start, nothing.groups.at("experienced").start);
  EXPECT_EQ(nothing.groups.at("novice").rate, 0);
  for (const Learners& l : {planted, nothing})
    EXPECT_LT(twin::readOperatorSkill(l.to).entry_sd, twin::readOperatorSkill(l.from).entry_sd);
  const Learners search = readLearners(shipped / "learners/search_learners.json",
                                       readProtocol(shipped / "search_study.json"));
  EXPECT_LT(twin::readSearchingSkill(search.to).weber_roughness,
            twin::readSearchingSkill(search.from).weber_roughness);
}

}  // namespace
}  // namespace palpa::study

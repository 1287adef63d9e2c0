#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "apps/console/sessions.h"
#include "tests/support/counts.h"
#include "tests/support/damage.h"

namespace palpa::console {
namespace {

using nlohmann::json;

/// As it comes over the network: numbers that are written alike are alike.
SessionWish wishOf(const json& asked) { return readWish(json::parse(asked.dump())); }

std::string refusalOf(const json& asked) {
  try {
    wishOf(asked);
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

json with(const char* field, const json& value) {
  json asked{{"task", "paracentesis"}};
  asked[field] = value;
  return asked;
}

TEST(SessionWish, WhatIsAskedForIsTaken) {
  const SessionWish wish = wishOf({{"task", "palpation"},
                                   {"trainee", "T017"},
                                   {"operator", "novice"},
                                   {"side", "left"},
                                   {"assess", true},
                                   {"force_feedback", false},
                                   {"sort", true},
                                   {"fingers", 2},
                                   {"surface", "oiled gel"},
                                   {"trials", 50},
                                   {"seed", 1'000'000'000},
                                   {"patient_seed", 7},
                                   {"more", {1, 2}}});
  EXPECT_EQ(wish.task, "palpation");
  EXPECT_EQ(wish.trainee, "T017");
  EXPECT_EQ(wish.performer, "novice");
  EXPECT_EQ(wish.side, "left");
  EXPECT_TRUE(wish.assess);
  EXPECT_FALSE(wish.force_feedback);
  EXPECT_TRUE(wish.sort);
  EXPECT_EQ(wish.fingers, 2);
  EXPECT_EQ(wish.surface, "oiled gel");
  EXPECT_EQ(wish.trials, 50);
  EXPECT_EQ(wish.seed, 1'000'000'000u);
  EXPECT_EQ(wish.patient_seed, 7u);
  EXPECT_EQ(wish.protocol, "");
  EXPECT_EQ(readWish({{"task", "search"}}).performer, "person");
}

/// Every field is refused by its name, in one line.
TEST(SessionWish, EveryBadWishIsRefusedInWords) {
  const std::string many(100'000, 'x');
  const std::pair<const char*, std::vector<json>> bad[] = {
      {"task",
       {nullptr, 1, true, json::array(), json::object(), "", "..", "../x", "a/b", "a b", many,
        "a\n", "\u00e4"}},
      {"trainee",
       {nullptr, 1, json::array(), "..", "-x", "--records", "_x", "a b", "Anna M\u00fcller",
        "<script>", "a'; DROP TABLE trainees; --", std::string("a\0b", 3), many}},
      {"operator", {nullptr, 1, "", "Person", "learner", "recorded", "automatic", "--fast", many}},
      {"side", {nullptr, 1, "", "both", "Right"}},
      {"assess", {nullptr, 0, 1, "true", ""}},
      {"force_feedback", {nullptr, 0, 1, "on"}},
      {"sort", {nullptr, 0, 1, "on"}},
      {"fingers", {nullptr, 0, 3, 1.5, "2", true}},
      {"surface", {nullptr, 1, true, json::array()}},
      {"trials",
       {nullptr, 0, -1, 51, 1.0, 1.5, "1", true, 4294967297ll, -9223372036854775807ll,
        18446744073709551615ull, 1e300}},
      {"seed", {nullptr, -1, 1'000'000'001, 1.5, "1", "1; rm -rf /", 18446744073709551615ull}},
      {"patient_seed", {nullptr, -1, 1'000'000'001, 1e30}}};
  for (const auto& [field, values] : bad)
    for (const json& value : values) {
      const std::string words = refusalOf(with(field, value));
      EXPECT_FALSE(words.empty()) << field << ' ' << value.dump().substr(0, 80);
      EXPECT_EQ(words.find('\n'), std::string::npos);
      EXPECT_LT(words.size(), 400u) << field;
    }
  EXPECT_NE(refusalOf(json::object()), "");
}

TEST(SessionWish, DamagedWishesAreWishesOrRefused) {
  test::DamageDice dice(8);
  const std::string whole =
      json{{"task", "paracentesis"}, {"trainee", "T017"}, {"operator", "expert"},
           {"side", "right"},        {"trials", 3},       {"seed", 12}}
          .dump();
  int taken = 0;
  for (int round = 0; round < test::counted(20'000, 500'000); ++round) {
    std::string text = whole;
    for (std::size_t hits = 1 + dice.below(3); hits > 0; --hits)
      text[dice.below(text.size())] = static_cast<char>(32 + dice.below(95));
    const json asked = json::parse(text, nullptr, false);
    if (!asked.is_object()) continue;
    try {
      const SessionWish wish = readWish(asked);
      ++taken;
      EXPECT_TRUE(isId(wish.task)) << text;
      EXPECT_TRUE(wish.trainee.empty() || isId(wish.trainee)) << text;
      EXPECT_TRUE(wish.trials >= 1 && wish.trials <= 50) << text;
    } catch (const UsageError&) {
    }
  }
  EXPECT_GT(taken, 100);
}

}  // namespace
}  // namespace palpa::console

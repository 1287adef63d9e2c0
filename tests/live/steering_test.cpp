#include "apps/live/wire.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "tests/support/counts.h"
#include "tests/support/damage.h"

namespace palpa::live {
namespace {

using nlohmann::json;
using trial::UserCommand;

trial::UserRequest parsed(const json& asked) { return parseSteering(asked.dump()); }

std::string refusalOf(const std::string& text) {
  try {
    parseSteering(text);
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

TEST(Steering, EveryKindIsItself) {
  const std::pair<const char*, UserCommand> kinds[] = {
      {"start", UserCommand::start},         {"pause", UserCommand::pause},
      {"abort", UserCommand::abort},         {"void", UserCommand::void_trial},
      {"stop", UserCommand::emergency_stop}, {"rearm", UserCommand::rearm},
      {"leave", UserCommand::quit},          {"note", UserCommand::note}};
  for (const auto& [name, command] : kinds) {
    const trial::UserRequest request =
        parsed({{"command", name}, {"reason", "the bed moved"}, {"at_s", 12.4}});
    EXPECT_EQ(request.command, command) << name;
    EXPECT_EQ(request.reason, "the bed moved");
    EXPECT_EQ(request.at_s, 12.4);
  }
  EXPECT_EQ(parsed({{"command", "void"}, {"reason", "the bed moved"}, {"trial", 2}}).trial, 2);
  EXPECT_EQ(parsed({{"command", "abort"}}).trial, 0) << "whichever is on";
  EXPECT_EQ(parsed({{"command", "start"}}).at_s, 0);
  EXPECT_EQ(parsed({{"command", "start"}}).reason, "");
}

/// What a console may not ask for: marking, grading and whatever else only the trainee's own keys
/// do.
TEST(Steering, WhatIsNoRequestIsRefusedInOneLine) {
  for (const std::string text : {"",
                                 " ",
                                 "null",
                                 "true",
                                 "1",
                                 "\"start\"",
                                 "[]",
                                 "[{\"command\":\"start\"}]",
                                 "{}",
                                 "{\"command\":null}",
                                 "{\"command\":1}",
                                 "{\"command\":[\"start\"]}",
                                 "{\"command\":\"\"}",
                                 "{\"command\":\"Start\"}",
                                 "{\"command\":\"start \"}",
                                 "{\"command\":\"done\"}",
                                 "{\"command\":\"grade\"}",
                                 "{\"command\":\"quit\"}",
                                 "{\"command\":\"start\",\"reason\":1}",
                                 "{\"command\":\"start\",\"reason\":null}",
                                 "{\"command\":\"start\"",
                                 "{\"command\":\"start\"}}",
                                 "{\"command\":\"st\\u0000art\"}",
                                 "{\"command\":\"abort\",\"trial\":0}",
                                 "{\"command\":\"abort\",\"trial\":1.5}",
                                 "{\"command\":\"abort\",\"trial\":\"1\"}",
                                 "{\"command\":\"abort\",\"trial\":null}",
                                 "{\"command\":\"abort\",\"trial\":1001}",
                                 "{\"command\":\"void\"}",
                                 "{\"command\":\"void\",\"reason\":\"\"}",
                                 "{\"command\":\"note\"}",
                                 "{\"command\":\"note\",\"reason\":\"\"}",
                                 "{\"command\":\"note\",\"reason\":\"\xff\xfe\"}",
                                 "{\"command\":\"note\",\"reason\":\"\\ud800\"}"}) {
    const std::string words = refusalOf(text);
    EXPECT_FALSE(words.empty()) << text;
    EXPECT_EQ(words.find('\n'), std::string::npos) << words;
  }
}

TEST(Steering, ControlCharactersAreRefusedWhereverTheyStand) {
  for (char c = 0; c < 0x20; ++c) {
    EXPECT_NE(refusalOf(json{{"command", "note"}, {"reason", std::string("a") + c + "b"}}.dump()),
              "")
        << static_cast<int>(c);
    EXPECT_NE(refusalOf(json{{"command", std::string("start") + c}}.dump()), "")
        << static_cast<int>(c);
  }
  EXPECT_NE(refusalOf(json{{"command", "note"}, {"reason", "\x7f"}}.dump()), "");
}

/// 500 characters as a person counts them, whatever their bytes.
TEST(Steering, ANoteHasUpTo500Characters) {
  for (const std::string character : {"a", "\"", "\u00e4", "\u91dd", "\U0001f489"}) {
    std::string text;
    for (int i = 0; i < 500; ++i) text += character;
    EXPECT_EQ(parsed({{"command", "note"}, {"reason", text}}).reason, text) << character;
    EXPECT_NE(refusalOf(json{{"command", "note"}, {"reason", text + character}}.dump()), "")
        << character;
  }
  EXPECT_NE(refusalOf(json{{"command", "note"}, {"reason", std::string(1 << 20, 'a')}}.dump()), "");
}

/// A moment that nanoseconds cannot hold, or that is before the session, would be told as one that
/// never was.
TEST(Steering, AMomentIsASecondOfTheSession) {
  EXPECT_EQ(parsed({{"command", "note"}, {"reason", "x"}, {"at_s", 0}}).at_s, 0);
  EXPECT_EQ(parsed({{"command", "note"}, {"reason", "x"}, {"at_s", 3600}}).at_s, 3600);
  for (const char* at :
       {"-1", "-0.001", "1e300", "1e7", "\"12\"", "null", "[]", "{}", "true", "1e999"})
    EXPECT_NE(refusalOf(std::string("{\"command\":\"note\",\"reason\":\"x\",\"at_s\":") + at + "}"),
              "")
        << at;
}

TEST(Steering, MarkupIsTextAndStaysWhatItIs) {
  const std::string markup = "<script>alert(1)</script>&amp;'\"=cmd|' /C calc'!A0";
  EXPECT_EQ(parsed({{"command", "note"}, {"reason", markup}}).reason, markup);
}

TEST(Steering, DeepAndHugeTextsAreRefusedWithoutHarm) {
  const auto many = static_cast<std::size_t>(test::counted(200'000, 4'000'000));
  EXPECT_NE(refusalOf(std::string(many, '[')), "");
  EXPECT_NE(refusalOf("{\"command\":" + std::string(many, '[') + std::string(many, ']') + "}"), "");
  EXPECT_NE(refusalOf("{\"command\":\"" + std::string(many, 'x') + "\"}"), "");
  EXPECT_LT(refusalOf("{\"command\":\"" + std::string(400, 'x') + "\"}").size(), 200u);
}

TEST(Steering, DamagedRequestsAreRequestsOrRefused) {
  test::DamageDice dice(4);
  const std::string whole =
      json{{"command", "note"}, {"reason", "needle too steep \u00e4\u91dd"}, {"at_s", 12.5}}.dump();
  int refused = 0;
  for (int round = 0; round < test::counted(20'000, 1'000'000); ++round) {
    std::string text = whole;
    for (std::size_t hits = 1 + dice.below(3); hits > 0; --hits)
      text[dice.below(text.size())] = static_cast<char>(dice.below(256));
    if (dice.below(4) == 0) text.resize(dice.below(text.size()));
    try {
      const trial::UserRequest request = parseSteering(text);
      EXPECT_TRUE(request.at_s >= 0 && request.at_s <= 1e6) << text;
    } catch (const UsageError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);  // and nothing but UsageError came
}

}  // namespace
}  // namespace palpa::live

#include "apps/room/messages.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/support/counts.h"
#include "tests/support/mutations.h"

namespace palpa::room {
namespace {

TEST(RoomTopics, AreReadAsTheyAreWritten) {
  for (const Topic topic :
       {Topic::about, Topic::state, Topic::events, Topic::heard, Topic::asks, Topic::answers}) {
    const auto read = addressedIn(topicOf("station_3", topic));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->station, "station_3");
    EXPECT_EQ(read->topic, topic);
  }
  for (const char* none : {"", "palpa", "palpa/", "palpa/a", "palpa//state", "palpa/a/b",
                           "palpa/a/state/x", "other/a/state", "palpa/a b/state", "palpa/+/state"})
    EXPECT_FALSE(addressedIn(none)) << none;
}

StationState someState() {
  StationState s;
  s.present = true;
  s.utc = "2026-03-01T10:00:00Z";
  s.session = "20260301-100000-ab";
  s.state = "running";
  s.task = "Access to the \"vein\"";
  s.trainee = "t-07";
  s.alarm = "Force taken away";
  s.trial = 2;
  s.trials = 5;
  s.elapsed_s = 12.5;
  s.emergency_stop = s.simulated = true;
  return s;
}

Happening someEvent() {
  return {"20260301-100000-ab", "0f-1", 7, 31.25, 2, "vein", "The tip is in the vein", "good"};
}

TEST(RoomMessages, AreReadAsTheyAreWritten) {
  const auto again = [](const auto& message, auto read) {
    EXPECT_EQ(toJson(read(wire(toJson(message)))), toJson(message));
  };
  again(StationFacts{"https://a.local/", "PEM", std::string(32, '7'), "1.2"}, stationFactsIn);
  again(someState(), stationStateIn);
  again(goneWithoutAWord(), stationStateIn);
  again(someEvent(), happeningIn);
  again(Heard{"20260301-100000-aa", "7", {{"20260301-100000-ab", {{"0f-1", 7}, {"0f-2", 0}}}}},
        heardIn);
  again(Ask{"q1", "", Ask::What::prepare, {{"task", "subclavian"}}}, askIn);
  again(Answer{"q1", false, "one is running already"}, answerIn);
}

TEST(RoomMessages, WhatIsNoneIsRefused) {
  const auto refused = [](auto change, const char* why) {
    nlohmann::json message = toJson(someEvent());
    change(message);
    EXPECT_THROW(happeningIn(wire(message)), UsageError) << why;
  };
  refused([](auto& m) { m.erase("number"); }, "no number");
  refused([](auto& m) { m["number"] = -1; }, "below all");
  refused([](auto& m) { m["number"] = 18446744073709551615u; }, "beyond all counts");
  refused([](auto& m) { m["session"] = "../etc"; }, "no id");
  refused([](auto& m) { m["text"] = std::string(3000, 'x'); }, "too long");
  EXPECT_THROW(happeningIn("[]"), UsageError);
  for (const char* url : {"http://10.0.0.1/", "javascript:alert(1)", "https://a/b", "https://a b/",
                          "http://127.0.0.1.evil.example/", "https://a/\r\nX: 1"})
    EXPECT_THROW(stationFactsIn(wire(toJson(StationFacts{url, "", std::string(32, '7'), "1"}))),
                 UsageError)
        << url;
  EXPECT_THROW(stationFactsIn(wire(toJson(StationFacts{"", "", "k\r\nX: 1", "1"}))), UsageError);
  nlohmann::json state = toJson(someState());
  state["state"] = "constructor";
  EXPECT_THROW(stationStateIn(wire(state)), UsageError);
  EXPECT_THROW(happeningIn(std::string(40'000, ' ')), UsageError);
  EXPECT_THROW(askIn(R"({"id": "a", "session": "s", "ask": "start"})"),
               UsageError);  // force begins at the station
  EXPECT_THROW(askIn(R"({"id": "a", "session": "s", "ask": "rearm"})"), UsageError);
  EXPECT_EQ(Heard{}.of("a", "b"), -1);
}

/// A message is read, or refused by an Error; nothing else happens.
TEST(RoomMessages, DamagedOnesAreReadOrRefused) {
  const int count = palpa::test::counted(2'000, 20'000);
  palpa::test::DamageDice dice(7);
  const std::string messages[] = {
      wire(toJson(someState())), wire(toJson(someEvent())),
      wire(toJson(Heard{"a", "", {{"b", {{"c", 7}}}}})),
      wire(toJson(Ask{"q1", "", Ask::What::prepare, {{"task", "subclavian"}}}))};
  int read = 0;
  for (int i = 0; i < count; ++i) {
    const std::string text = palpa::test::mutated(messages[dice.below(4)], dice);
    try {
      stationStateIn(text);
      ++read;
    } catch (const Error&) {
    }
    try {
      happeningIn(text);
      ++read;
    } catch (const Error&) {
    }
    try {
      heardIn(text);
      askIn(text);
      ++read;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace palpa::room

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/live/live_sink.h"

namespace palpa::live {
namespace {

using nlohmann::json;

haptics::FlightRecord tickAt(std::int64_t t_ns, double force_N, std::uint32_t trial = 1) {
  haptics::FlightRecord record{};
  record.t_ns = t_ns;
  record.f_contact_D = Packed3{0, 0, static_cast<float>(force_N)};
  record.commands.trial = trial;
  record.commands.armed = 1;
  return record;
}

TEST(Curve, OneTickOf20MsStays_TheOneWithTheGreatestForce) {
  ForceCurve curve;
  for (int ms = 0; ms < 1000; ++ms) curve.add(tickAt(ms * 1'000'000ll, ms % 20 == 7 ? 3 : 1));
  ASSERT_EQ(curve.points().size(), 49u);  // the last 20 ms are not over yet
  for (std::size_t i = 0; i < curve.points().size(); ++i) {
    EXPECT_NEAR(curve.points()[i].t_s, 0.02 * static_cast<double>(i) + 0.007, 1e-9);
    EXPECT_NEAR(curve.points()[i].force_N, 3, 1e-6);
  }
  const json entry = json::parse(curve.take());
  EXPECT_EQ(entry["kind"], "curve");
  EXPECT_EQ(entry["t_s"].size(), 49u);
  EXPECT_EQ(entry["force_N"].size(), 49u);
  EXPECT_EQ(entry["depth_mm"].size(), 49u);
  EXPECT_EQ(curve.take(), "");
}

TEST(Curve, WhatIsNoNumberIsToldAsNone) {
  ForceCurve curve;
  for (const double force : {std::nan(""), std::numeric_limits<double>::infinity(), 2.0})
    curve.add(tickAt(static_cast<std::int64_t>(curve.points().size()) * 20'000'000 +
                         (std::isnan(force)   ? 0
                          : std::isinf(force) ? 20'000'000
                                              : 40'000'000),
                     force));
  const json entry = json::parse(curve.take());
  for (const json& value : entry["force_N"]) EXPECT_TRUE(value.is_number());
}

TEST(LiveLog, WhoeverReadsOnGetsEachEntryOnceWhileOthersWrite) {
  LiveLog log;
  constexpr int kEach = 5000;
  std::vector<std::string> read;
  std::thread writer([&] {
    for (int i = 0; i < kEach; ++i) log.add(std::to_string(i));
  });
  while (read.size() < kEach)
    for (std::string& entry : log.since(read.size(), 97)) read.push_back(std::move(entry));
  writer.join();
  for (int i = 0; i < kEach; ++i) ASSERT_EQ(read[static_cast<std::size_t>(i)], std::to_string(i));
  EXPECT_TRUE(log.since(kEach, 10).empty());
  EXPECT_TRUE(log.since(std::numeric_limits<std::size_t>::max(), 10).empty());
  EXPECT_EQ(log.since(kEach - 3, std::numeric_limits<std::size_t>::max()).size(), 3u);
}

TEST(LiveLog, WhatPassesEndsAtItsBound_WhatHappensIsToldBeyondIt) {
  LiveLog log;
  for (std::size_t i = 0; i < LiveLog::kMostPassing + 10; ++i) log.addPassing("", 1);
  EXPECT_EQ(log.size(), LiveLog::kMostPassing);
  log.add("{\"kind\":\"event\"}");
  EXPECT_EQ(log.size(), LiveLog::kMostPassing + 1);
}

/// A session of hours keeps what passed in two trials, and every entry its number.
TEST(LiveLog, ForgetsWhatPassedInOlderTrials_NothingElse) {
  LiveLog log;
  for (std::uint32_t trial = 1; trial <= 4; ++trial) {
    log.add("begins " + std::to_string(trial));
    log.addPassing("curve a " + std::to_string(trial), trial);
    log.addPassing("curve b " + std::to_string(trial), trial);
  }
  log.addPassing("late c 3", 3);  // from another thread
  const std::string gone = R"({"kind":"curve"})";
  EXPECT_EQ(log.since(0, 100),
            (std::vector<std::string>{"begins 1", gone, gone, "begins 2", gone, gone, "begins 3",
                                      "curve a 3", "curve b 3", "begins 4", "curve a 4",
                                      "curve b 4", "late c 3"}));
}

/// Notes what it is given; refuses when asked to.
struct Evidence final : runtime::FlightSink {
  std::vector<std::string> got;
  bool full = false;
  void note(const char* what) {
    if (full) throw std::runtime_error("no space left on device");
    got.emplace_back(what);
  }
  void beginTrial(const runtime::TrialHeader&) override { note("begin"); }
  void snapshot(const LocalGeometry&) override { note("snapshot"); }
  void tick(const haptics::FlightRecord&) override { note("tick"); }
  void keyframe(std::int64_t, const haptics::TickState&) override { note("keyframe"); }
  void event(const runtime::Event&) override { note("event"); }
  void endTrial(const runtime::TrialEnd&) override { note("end"); }
  void commit() override { note("commit"); }
};

struct Session {
  Evidence evidence;
  LiveLog log;
  std::string near;
  LiveSink sink{evidence, log, [this](const haptics::FlightRecord&) { return near; },
                [](const runtime::Event& event) {
                  return std::string(event.kind == "puncture" ? "good"
                                     : event.kind == "note"   ? "note"
                                                              : "neutral");
                }};
  std::vector<json> told() const {
    std::vector<json> all;
    for (const std::string& entry : log.since(0, 1'000'000)) all.push_back(json::parse(entry));
    return all;
  }
};

TEST(LiveSink, EvidenceGetsEverythingAndTheLogWhatCanBeTold) {
  Session s;
  s.sink.beginTrial({});
  for (int ms = 0; ms < 100; ++ms) s.sink.tick(tickAt(ms * 1'000'000ll, 1));
  s.sink.snapshot({});
  s.sink.keyframe(1, {});
  s.sink.event({1'500'000'000, 1, "puncture", "Skin punctured at 1.8 N", 1.8});
  s.sink.event({1'550'000'000, 1, "picture", "view-01-01-puncture.png: Punctured", 1});
  s.sink.event({1'600'000'000, 1, "note", "<b>good</b>", 0});
  s.sink.commit();
  s.sink.endTrial({});
  EXPECT_EQ(s.evidence.got.size(), 108u);
  const std::vector<json> told = s.told();
  ASSERT_EQ(told.size(), 5u);
  EXPECT_EQ(told[0]["kind"], "trial");
  EXPECT_EQ(told[1]["tone"], "good");
  EXPECT_EQ(told[1]["t_s"], 1.5);
  EXPECT_EQ(told[2]["text"], "<b>good</b>");
  EXPECT_EQ(told[2]["tone"], "note");
  EXPECT_EQ(told[3]["kind"], "curve");
  EXPECT_EQ(told[4]["kind"], "trial_end");
}

TEST(LiveSink, TicksOutsideTrialsAreNotTold) {
  Session s;
  for (int ms = 0; ms < 100; ++ms) s.sink.tick(tickAt(ms * 1'000'000ll, 5, 0));
  s.sink.commit();
  EXPECT_EQ(s.log.size(), 0u);
  EXPECT_EQ(s.evidence.got.size(), 101u);
}

/// Both are judged, so whoever looks on sees both.
TEST(LiveSink, OfTwoToolsTheCurveIsOfTheOneThatIsPressedHarder) {
  Session s;
  for (int ms = 0; ms < 100; ++ms) {
    haptics::FlightRecord second = tickAt(ms * 1'000'000ll, 5);
    second.tool = 1;
    s.sink.tick(tickAt(ms * 1'000'000ll, 2));
    s.sink.tick(second);
  }
  s.sink.commit();
  const std::vector<json> told = s.told();
  ASSERT_EQ(told.size(), 1u);
  ASSERT_GE(told[0]["force_N"].size(), 4u) << "20 ms each";
  for (const json& force : told[0]["force_N"]) EXPECT_EQ(force, 5);
}

TEST(LiveSink, ANearMissIsToldWhenItsWordsChange) {
  Session s;
  const auto commit = [&](const std::string& near) {
    s.near = near;
    s.sink.tick(tickAt(0, 0));
    s.sink.commit();
  };
  for (const char* near : {"", "2 mm from the pleura", "2 mm from the pleura",
                           "1 mm from the pleura", "", "1 mm from the pleura"})
    commit(near);
  EXPECT_EQ(s.log.size(), 3u);
}

/// A full disk is the evidence's to tell: it passes through, and nothing is told that was not kept.
TEST(LiveSink, WhatTheEvidenceRefusesIsNotTold) {
  Session s;
  s.evidence.full = true;
  EXPECT_THROW(s.sink.event({0, 1, "puncture", "", 0}), std::runtime_error);
  EXPECT_THROW(s.sink.beginTrial({}), std::runtime_error);
  EXPECT_EQ(s.log.size(), 0u);
}

TEST(LiveSink, WordsThatAreNoUtf8AreToldReadably) {
  Session s;
  s.sink.event({0, 1, "note", "\xff\xfe\x80 caf\xe9\n\t\"", 0});
  EXPECT_EQ(s.told().size(), 1u);  // it parses
}

}  // namespace
}  // namespace palpa::live

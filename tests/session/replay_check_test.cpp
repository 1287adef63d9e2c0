#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "apps/evidence/recorded_session.h"
#include "haptics/loop/tick.h"
#include "tests/haptics/needle_bench.h"
#include "tests/record/synthetic_session.h"

/// What a replay calls equal, equal but for rounding, and changed.
namespace palpa::evidence {
namespace {

constexpr std::int64_t kTicks = 600, kKeyframe = 100;

haptics::DeviceReading readingOf(std::int64_t tick) {
  auto reading = record::test::zeroed<haptics::DeviceReading>();
  const double depth = 0.012 - 0.017 * std::cos(0.006 * static_cast<double>(tick));
  reading.t_ns = tick * 1'000'000;
  reading.sequence = static_cast<std::uint64_t>(tick + 1);
  reading.homed = 1;
  reading.q_DE = {0, 1, 0, 0};
  reading.p_DE = {0, 0, 0.11 - depth};
  return reading;
}

/// What another maker of the record does otherwise.
struct Otherwise {
  double stiffer = 1;  ///< skin and tissue of the ticks, not of the record's description
  std::function<void(haptics::TickState&)> at_250;
  std::function<void(haptics::FlightRecord&)> written;
};

/// A needle that dips into a block, recorded and run again.
ReplayCheck replayed(const Otherwise& otherwise) {
  record::SessionInfo info = record::test::syntheticInfo();
  info.tick_config = {};
  info.tick_config.materials = haptics::NeedleBench{}.materials;
  info.tick_config.X_ET.p = {0, 0, 0.11};
  haptics::TickConfig config = info.tick_config;
  config.materials.skin.K_0 *= otherwise.stiffer;
  const auto file = test::freshFolder("session", "replay_check") / "session.palpa";
  record::SessionWriter writer(file, info);
  writer.beginTrial({1, 0, 1, "scored", true, 1.5});
  haptics::TickState state;
  haptics::TickCommands commands;
  commands.armed = commands.trial = 1;
  LocalGeometry geometry = haptics::NeedleBench{}.geometry;
  for (std::int64_t tick = 0; tick < kTicks; ++tick) {
    if (tick % 16 == 0) {
      geometry.number = static_cast<std::uint64_t>(tick / 16 + 1);
      geometry.t_ns = tick * 1'000'000;
      writer.snapshot(geometry);
    }
    if (tick % kKeyframe == 0) writer.keyframe(tick, state);
    if (tick == 250 && otherwise.at_250) otherwise.at_250(state);
    haptics::FlightRecord made = haptics::tick(config, state, readingOf(tick), &geometry, commands,
                                               tick * 1'000'000, {}, nullptr);
    if (otherwise.written) otherwise.written(made);
    writer.tick(made);
  }
  writer.close();
  return replayTicks(record::SessionReader(file));
}

TEST(ReplayCheck, TheSameArithmeticGivesTheSameBits) {
  const ReplayCheck check = replayed({});
  EXPECT_EQ(check.recorded, kTicks);
  EXPECT_EQ(check.ticks, kTicks);
  EXPECT_EQ(check.different, 0);
  EXPECT_EQ(check.likeness(), Likeness::same_bits);
}

TEST(ReplayCheck, AnotherLastBitIsRounding) {
  const ReplayCheck check = replayed({1 + 1e-14, {}, {}});
  EXPECT_GT(check.different, 10);
  EXPECT_EQ(check.changed, 0);
  EXPECT_GT(check.largest, 0);
  EXPECT_LT(check.largest, kRounding);
  EXPECT_EQ(check.likeness(), Likeness::rounding);
}

TEST(ReplayCheck, AnotherStiffnessIsAChange) {
  const ReplayCheck check = replayed({1 + 1e-4, {}, {}});
  EXPECT_GT(check.changed, 10);
  EXPECT_GE(check.first_change, check.first_difference);
  EXPECT_EQ(check.likeness(), Likeness::changed);
}

TEST(ReplayCheck, OneForceThatWasRaisedIsFound) {
  const auto raised = [](double by) {
    return Otherwise{1, {}, [by](haptics::FlightRecord& made) {
                       if (made.tick == 333) made.f_command_D[2] += by;
                     }};
  };
  const ReplayCheck check = replayed(raised(1e-6));
  EXPECT_EQ(check.changed, 1);
  EXPECT_EQ(check.first_change, 333);
  EXPECT_EQ(replayed(raised(1e-10)).likeness(), Likeness::rounding);
  EXPECT_EQ(replayed(raised(std::numeric_limits<double>::quiet_NaN())).changed, 1);
}

TEST(ReplayCheck, AnEventIsNoRounding) {
  const ReplayCheck check = replayed({1, {}, [](haptics::FlightRecord& made) {
                                        if (made.tick == 100) made.events ^= haptics::kWithdrawn;
                                      }});
  EXPECT_EQ(check.changed, 1);
  EXPECT_EQ(check.largest, 0);
}

/// Its state has strayed from tick 250 on; the keyframe at 300 knows it.
TEST(ReplayCheck, FromTheNextKeyframeOnItFollowsTheRecordAgain) {
  const ReplayCheck check =
      replayed({1, [](haptics::TickState& state) { state.contact = {}; }, {}});
  EXPECT_GE(check.first_change, 250);
  EXPECT_LE(check.changed, 50);
  EXPECT_LE(check.different, 50);
  EXPECT_EQ(check.gaps, 0);
}

TEST(Likeness, OfNumbersIsRelativeAboveOne) {
  const double none = std::numeric_limits<double>::quiet_NaN(),
               endless = std::numeric_limits<double>::infinity();
  EXPECT_EQ(likeness(0.0, -0.0), Likeness::same_bits);
  EXPECT_EQ(likeness(none, none), Likeness::same_bits);
  EXPECT_EQ(likeness(endless, endless), Likeness::same_bits);
  EXPECT_EQ(likeness(0.5, 0.5 + 0.9e-9), Likeness::rounding);
  EXPECT_EQ(likeness(0.5, 0.5 + 1.1e-9), Likeness::changed);
  EXPECT_EQ(likeness(1000, 1000 + 0.9e-6), Likeness::rounding);
  EXPECT_EQ(likeness(1000, 1000 + 1.1e-6), Likeness::changed);
  EXPECT_EQ(likeness(0, none), Likeness::changed);
  EXPECT_EQ(likeness(1e300, endless), Likeness::changed);
}

TEST(Likeness, OfScoresLooksAtEveryField) {
  const std::string score = R"({"TOTAL": 12.5, "MARKS": [{"at": 0.25}], "WORD": "success"})";
  EXPECT_EQ(likenessOfJson(score, score), Likeness::same_bits);
  EXPECT_EQ(
      likenessOfJson(score, R"({"WORD":"success","TOTAL":12.5000000001,"MARKS":[{"at":0.25}]})"),
      Likeness::rounding);
  for (const char* other : {R"({"TOTAL": 12.6, "MARKS": [{"at": 0.25}], "WORD": "success"})",
                            R"({"TOTAL": 12.5, "MARKS": [{"at": 0.25}], "WORD": "time"})",
                            R"({"TOTAL": 12.5, "MARKS": [{"at": 0.26}], "WORD": "success"})",
                            R"({"TOTAL": 12.5, "MARKS": [], "WORD": "success"})",
                            R"({"TOTAL": 12.5, "MARKS": [{"at": 0.25}], "WORDS": "success"})",
                            R"({"TOTAL": 12.5, "MARKS": [{"at": null}], "WORD": "success"})"})
    EXPECT_EQ(likenessOfJson(score, other), Likeness::changed) << other;
}

}  // namespace
}  // namespace palpa::evidence

#include <gtest/gtest.h>

#include <cmath>

#include "apps/replay/needle_replay.h"
#include "apps/replay/player.h"

namespace palpa::replay {
namespace {

/// A key that types what it is called by.
void press(Player& player, const char* key, bool shift) { player.key(key, key, shift); }

TEST(Player, SpeedGoesByWhatAKeyTypesAndTheRestByItsPlace) {
  Player player(0, 10, 1);
  player.key("6", "minus", false);  // a French keyboard's
  EXPECT_NEAR(player.speed(), std::sqrt(0.5), 1e-12);
  player.key("a", "q", false);
  EXPECT_FALSE(player.left());
  player.key("q", "Greek_semicolon", false);
  EXPECT_TRUE(player.left());
}

TEST(Player, GoesOnAtItsSpeedAndStopsAtTheEnd) {
  Player player(2, 10, 0.5);
  player.advance(4);
  EXPECT_NEAR(player.at_s(), 4, 1e-12);
  EXPECT_EQ(player.words(), "x 0.5");
  player.advance(100);
  EXPECT_EQ(player.at_s(), 10);
  EXPECT_TRUE(player.paused());
  press(player, "space", false);  // from the start again
  EXPECT_EQ(player.at_s(), 2);
  EXPECT_FALSE(player.paused());
}

TEST(Player, PausedItStands) {
  Player player(0, 10, 1);
  player.advance(3);
  press(player, "space", false);
  player.advance(3);
  EXPECT_EQ(player.at_s(), 3);
  EXPECT_EQ(player.words(), "paused");
  press(player, "Right", true);
  EXPECT_NEAR(player.at_s(), 3.04, 1e-12);
  press(player, "Left", true);
  EXPECT_NEAR(player.at_s(), 3, 1e-12);
}

TEST(Player, ArrowsJumpAndNeverLeaveTheCut) {
  Player player(1, 8, 1);
  press(player, "Left", false);
  EXPECT_EQ(player.at_s(), 1);
  press(player, "Right", false);
  EXPECT_EQ(player.at_s(), 2);
  press(player, "Up", false);
  EXPECT_EQ(player.at_s(), 7);
  press(player, "Up", false);
  EXPECT_EQ(player.at_s(), 8);
  press(player, "Home", false);
  EXPECT_EQ(player.at_s(), 1);
  EXPECT_FALSE(player.left());
  press(player, "Escape", false);
  EXPECT_TRUE(player.left());
}

TEST(Player, SpeedStaysWithinItsLimits) {
  Player player(0, 1, 1);
  for (int i = 0; i < 2; ++i) press(player, "plus", false);
  EXPECT_NEAR(player.speed(), 2, 1e-12);
  for (int i = 0; i < 40; ++i) press(player, "minus", false);
  EXPECT_EQ(player.speed(), kSlowest);
  for (int i = 0; i < 40; ++i) press(player, "plus", false);
  EXPECT_EQ(player.speed(), kFastest);
}

TEST(Marks, WordsStandForAWhileAndTheLatestWins) {
  const std::vector<StripMark> marks{{1, scene::TickTone::neutral, "Skin punctured"},
                                     {2, scene::TickTone::bad, "Artery"}};
  EXPECT_EQ(wordsAt(marks, 0.9), "");
  EXPECT_EQ(wordsAt(marks, 1), "Skin punctured");
  EXPECT_EQ(wordsAt(marks, 2.2), "Artery");
  EXPECT_EQ(wordsAt(marks, 2 + kMarkShown), "");
}

haptics::FlightRecord tickAt(double t_s, double plunger, Tissue tissue) {
  haptics::FlightRecord record;
  record.tick = std::llround(1000 * t_s);
  record.t_ns = 1'000'000 * record.tick;
  record.commands.trial = 2;
  record.commands.armed = 1;
  record.reading.p_DE = {0.01 * t_s, 0, 0};
  record.reading.q_DE = {1, 0, 0, 0};
  record.reading.plunger = plunger;
  record.phase = haptics::NeedlePhase::inserted;
  record.tissue = tissue;
  return record;
}

TEST(Moments, TheyAreThoseOfTheTrialAndBloodFillsAQuarterASecond) {
  MomentReader reader(Pose::Identity(), pack(Pose::Identity()), 2);
  haptics::FlightRecord other = tickAt(0, 0, Tissue::air);
  other.commands.trial = 1;
  reader.add(other);
  for (int i = 0; i < 2000; ++i) {
    haptics::FlightRecord record =
        tickAt(1 + 1e-3 * i, 0.5, i < 1000 ? Tissue::air : Tissue::vein_lumen);
    record.commands.asked = i >= 1800;
    reader.add(record);
  }
  const std::vector<NeedleMoment>& moments = reader.moments();
  ASSERT_EQ(moments.size(), 500u);  // every 4 ms
  EXPECT_EQ(moments[249].flows, Tissue::air);
  EXPECT_EQ(moments[251].flows, Tissue::vein_lumen);
  EXPECT_NEAR(moments.back().blood, 0.25 * (moments.back().t_s - moments[249].t_s), 0.003);
  const std::size_t middle = momentAt(moments, moments[100].t_s + 0.003);
  EXPECT_EQ(middle, 100u);
  EXPECT_EQ(momentAt(moments, -1), 0u);
  EXPECT_EQ(momentAt(moments, 99), moments.size() - 1);
  EXPECT_NEAR(unpack(moments[100].tool.X_DT).translation().x(), 0.014, 1e-9);
  const task_needle::TaskStatus status = statusAt(moments.back(), 2, false);
  EXPECT_EQ(status.trial, 2);
  EXPECT_FALSE(status.force_feedback);
  EXPECT_EQ(status.flows, Tissue::vein_lumen);
  EXPECT_TRUE(status.asked);
  EXPECT_FALSE(statusAt(moments[400], 2, false).asked);
}

}  // namespace
}  // namespace palpa::replay

#include "apps/assess/dose_counter.h"

#include <gtest/gtest.h>

namespace palpa::assess {
namespace {

/// Two of each part.
haptics::AugmentationPlan plannedDoses() {
  haptics::AugmentationPlan plan;
  plan.each[0].subtask = plan.each[1].subtask = 0;
  plan.each[2].subtask = 1;
  plan.each[3].subtask = 1;
  plan.count = 4;
  return plan;
}

DoseCounter twoParts() { return {plannedDoses(), {"look", "press"}}; }

/// Bits as in the record; the force of all that was added, N.
haptics::FlightRecord dosed(unsigned parts, unsigned augmenting = 0, double added_N = 0) {
  haptics::FlightRecord record;
  record.commands.armed = 1;
  record.subtasks = static_cast<std::uint8_t>(parts);
  record.augmenting = static_cast<std::uint8_t>(augmenting);
  record.f_augmentation_D = {0, 0.6 * added_N, -0.8 * added_N};
  return record;
}

void addFor(DoseCounter& counter, const haptics::FlightRecord& record, int ticks) {
  for (int i = 0; i < ticks; ++i) counter.add(record, 1e-3);
}

TEST(DoseCounter, CountsSecondsAndTimesOfEachPart) {
  DoseCounter counter = twoParts();
  addFor(counter, dosed(0b01), 300);
  addFor(counter, dosed(0b11), 200);  // both at once
  addFor(counter, dosed(0b00), 100);
  addFor(counter, dosed(0b01), 50);
  addFor(counter, dosed(0b10), 70);
  addFor(counter, dosed(0b01), 30);
  ASSERT_EQ(counter.doses().size(), 2u);
  const SubtaskDose &look = counter.doses()[0], &press = counter.doses()[1];
  EXPECT_EQ(look.subtask, "look");
  EXPECT_NEAR(look.on_s, 0.580, 1e-9);
  EXPECT_EQ(look.times, 3);
  EXPECT_EQ(press.subtask, "press");
  EXPECT_NEAR(press.on_s, 0.270, 1e-9);
  EXPECT_EQ(press.times, 2);
  for (const SubtaskDose& dose : counter.doses()) EXPECT_EQ(dose.augmented_s + dose.impulse_Ns, 0);
}

TEST(DoseCounter, ATremblingHandDoesAPartOnce) {
  DoseCounter counter = twoParts();
  for (int i = 0; i < 50; ++i) {
    addFor(counter, dosed(0b01), 8);
    addFor(counter, dosed(0b00), 12);
  }
  EXPECT_EQ(counter.doses()[0].times, 50) << "a cue of the beginning was felt so often";
  EXPECT_EQ(counter.doses()[0].occasions, 1);
  EXPECT_NEAR(counter.doses()[0].on_s, 0.4, 1e-9);
  addFor(counter, dosed(0b00), 230);  // with the 12 before: less than it takes to leave
  addFor(counter, dosed(0b01), 8);
  EXPECT_EQ(counter.doses()[0].occasions, 1);
  addFor(counter, dosed(0b00), 251);
  addFor(counter, dosed(0b01), 8);
  EXPECT_EQ(counter.doses()[0].occasions, 2);
}

TEST(DoseCounter, WhatIsAddedIsThePartsItBelongsTo) {
  DoseCounter counter = twoParts();
  addFor(counter, dosed(0b11, 0b0001, 2), 100);
  addFor(counter, dosed(0b11, 0b0010, 1), 50);
  addFor(counter, dosed(0b11, 0b0011, 4), 10);  // two of one part: felt once, together
  addFor(counter, dosed(0b11, 0b0100, 3), 40);
  addFor(counter, dosed(0b11), 500);
  const SubtaskDose &look = counter.doses()[0], &press = counter.doses()[1];
  EXPECT_NEAR(look.augmented_s, 0.160, 1e-9);
  EXPECT_NEAR(look.impulse_Ns, 0.1 * 2 + 0.05 * 1 + 0.01 * 4, 1e-9);
  EXPECT_NEAR(press.augmented_s, 0.040, 1e-9);
  EXPECT_NEAR(press.impulse_Ns, 0.04 * 3, 1e-9);
  EXPECT_NEAR(look.on_s, 0.7, 1e-9);
}

TEST(DoseCounter, WhatBelongsToNoPartHasARowOfItsOwn) {
  haptics::AugmentationPlan plan = plannedDoses();
  plan.each[3].subtask = haptics::kAnySubtask;
  DoseCounter counter(plan, {"look", "press"});
  addFor(counter, dosed(0b11, 0b1000, 2), 100);
  addFor(counter, dosed(0), 50);
  ASSERT_EQ(counter.doses().size(), 3u);
  const SubtaskDose &look = counter.doses()[0], &any = counter.doses()[2];
  EXPECT_EQ(look.augmented_s + look.impulse_Ns, 0);
  EXPECT_EQ(any.subtask, "any part");
  EXPECT_NEAR(any.on_s, 0.150, 1e-9);
  EXPECT_EQ(any.times, 1);
  EXPECT_NEAR(any.augmented_s, 0.100, 1e-9);
  EXPECT_NEAR(any.impulse_Ns, 0.2, 1e-9);
}

TEST(DoseCounter, TicksCountAsLongAsTheyAre) {
  DoseCounter counter = twoParts();
  counter.add(dosed(0b01, 0b0001, 2), 0.001);
  counter.add(dosed(0b01, 0b0001, 2), 0.004);
  EXPECT_NEAR(counter.doses()[0].on_s, 0.005, 1e-12);
  EXPECT_NEAR(counter.doses()[0].augmented_s, 0.005, 1e-12);
  EXPECT_NEAR(counter.doses()[0].impulse_Ns, 0.010, 1e-12);
}

TEST(DoseCounter, WithoutPartsThereAreNoDoses) {
  DoseCounter counter;
  addFor(counter, dosed(0b11, 0b11, 2), 10);
  EXPECT_TRUE(counter.doses().empty());
}

/// A recorded session at 1 kHz, tick by tick.
struct DosedSession {
  TrialDoses doses{plannedDoses(), {"look", "press"}};
  std::int64_t now = 0;
  void ticks(int count, std::uint32_t trial, bool armed, unsigned parts, unsigned augmenting = 0) {
    for (int i = 0; i < count; ++i) {
      haptics::FlightRecord record = dosed(parts, augmenting, 2);
      record.commands.trial = trial;
      record.commands.armed = armed;
      record.t_ns = now += 1'000'000;
      doses.add(record);
    }
  }
};

TEST(TrialDoses, AreOfTheirTrialWhileForcesMayBeRendered) {
  DosedSession session;
  session.doses.begin(2);
  session.ticks(100, 1, true, 0b01);
  session.ticks(50, 2, false, 0b01);
  session.ticks(201, 2, true, 0b01, 0b0001);  // the first only says when it begins
  session.ticks(300, 2, false, 0b01);
  session.ticks(101, 2, true, 0b10);  // after the pause likewise
  session.ticks(100, 3, true, 0b01);
  EXPECT_NEAR(session.doses.doses()[0].on_s, 0.2, 1e-9);
  EXPECT_NEAR(session.doses.doses()[0].impulse_Ns, 0.4, 1e-9);
  EXPECT_EQ(session.doses.doses()[0].times, 1);
  EXPECT_NEAR(session.doses.doses()[1].on_s, 0.1, 1e-9);
}

TEST(TrialDoses, BeginAnewWithEveryTrial) {
  DosedSession session;
  session.doses.begin(1);
  session.ticks(500, 1, true, 0b11, 0b0111);
  session.doses.begin(2);
  for (const SubtaskDose& dose : session.doses.doses())
    EXPECT_EQ(dose.on_s + dose.times + dose.augmented_s + dose.impulse_Ns, 0);
  session.ticks(11, 2, true, 0b01);
  EXPECT_NEAR(session.doses.doses()[0].on_s, 0.010, 1e-12);
  EXPECT_EQ(session.doses.doses()[0].times, 1);
}

}  // namespace
}  // namespace palpa::assess

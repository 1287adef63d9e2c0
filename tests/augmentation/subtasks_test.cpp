#include "haptics/augmentation/subtasks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace palpa::haptics {
namespace {

Subtasks one(const Condition& c) {
  Subtasks s;
  s.each[0].conditions[0] = c;
  s.each[0].count = 1;
  s.count = 1;
  return s;
}

SignalValues speed(double v) {
  SignalValues signals;
  signals[Signal::floor_speed] = v;
  return signals;
}

TEST(Subtasks, OnAtItsThresholdOffFivePercentBelow) {
  const Subtasks s = one({Signal::floor_speed, Condition::Compare::at_least, 0, {}, 468.75, 0.05});
  SubtaskState state;
  EXPECT_EQ(detect(s, speed(468.74), 1, &state), 0u);
  EXPECT_EQ(state.on, 0u);
  EXPECT_EQ(detect(s, speed(468.75), 2, &state), 1u);
  EXPECT_EQ(state.on, 1u);
  EXPECT_EQ(state.since_ns[0], 2);
  EXPECT_EQ(detect(s, speed(0.95 * 468.75 + 1e-6), 3, &state), 0u);
  EXPECT_EQ(state.on, 1u);
  EXPECT_EQ(state.since_ns[0], 3);
  detect(s, speed(0.95 * 468.75 - 1e-6), 4, &state);
  EXPECT_EQ(state.on, 0u);
  EXPECT_EQ(state.since_ns[0], 4);
}

/// A hand that trembles about the threshold, 10 times a second, by a fifth of it.
int timesOnIn(double seconds, std::uint16_t hold_ms) {
  const Subtasks s =
      one({Signal::floor_speed, Condition::Compare::at_least, hold_ms, {}, 468.75, 0.05});
  SubtaskState state;
  int times = 0;
  for (int i = 0; i < static_cast<int>(1000 * seconds); ++i)
    times += detect(s, speed(468.75 * (1 + 0.2 * std::sin(2 * M_PI * 10 * 1e-3 * i))),
                    1'000'000LL * i, &state) != 0;
  return times;
}

TEST(Subtasks, AHoldKeepsAPartFromFlickering) {
  EXPECT_EQ(timesOnIn(10, 0), 100);
  EXPECT_EQ(timesOnIn(10, 100), 1) << "it holds again before the hold ends";
  const Subtasks s = one({Signal::floor_contact, Condition::Compare::at_least, 100, {}, 1, 0});
  SubtaskState state;
  SignalValues signals;
  signals[Signal::floor_contact] = 1;
  EXPECT_EQ(detect(s, signals, 1'000'000'000, &state), 1u) << "on at once";
  signals[Signal::floor_contact] = 0;
  detect(s, signals, 1'099'000'000, &state);
  EXPECT_EQ(state.on, 1u);
  detect(s, signals, 1'100'000'000, &state);
  EXPECT_EQ(state.on, 0u) << "and off when it is over";
}

/// A hand that strokes at up to 800 U/s, and turns round 10 times a second.
TEST(Subtasks, WhatMustHoldForAWhileDoesNotBeginWhereTheHandTurns) {
  const auto beginnings = [](std::uint32_t after_ms) {
    const Subtasks s =
        one({Signal::floor_speed, Condition::Compare::below, 0, after_ms, 468.75, 0.05});
    SubtaskState state;
    int times = 0;
    for (std::int64_t i = 1; i <= 10'000; ++i)
      times += detect(s, speed(800 * std::abs(std::cos(2 * M_PI * 5e-3 * static_cast<double>(i)))),
                      1'000'000 * i, &state) != 0;
    return times;
  };
  EXPECT_EQ(beginnings(0), 100);
  EXPECT_EQ(beginnings(100), 0);
  const Subtasks s = one({Signal::floor_speed, Condition::Compare::below, 0, 100, 468.75, 0.05});
  SubtaskState state;
  detect(s, speed(500), 1'000'000'000, &state);
  detect(s, speed(400), 1'099'000'000, &state);
  EXPECT_EQ(state.on, 0u);
  EXPECT_EQ(detect(s, speed(400), 1'100'000'000, &state), 1u);
  detect(s, speed(500), 1'101'000'000, &state);
  EXPECT_EQ(state.on, 0u) << "off at once";
}

TEST(Subtasks, BelowIsTheMirrorImage) {
  const Subtasks s = one({Signal::floor_speed, Condition::Compare::below, 0, {}, 100, 0.05});
  SubtaskState state;
  detect(s, speed(100), 1, &state);
  EXPECT_EQ(state.on, 0u);
  detect(s, speed(99.9), 2, &state);
  EXPECT_EQ(state.on, 1u);
  detect(s, speed(104.9), 3, &state);
  EXPECT_EQ(state.on, 1u);
  detect(s, speed(105), 4, &state);
  EXPECT_EQ(state.on, 0u);
}

TEST(Subtasks, HysteresisOfANegativeThresholdGoesTheRightWay) {
  SignalValues signals;
  const Subtasks s = one({Signal::lump_edge, Condition::Compare::at_least, 0, {}, -0.004, 0.1});
  SubtaskState state;
  signals[Signal::lump_edge] = -0.0039;
  detect(s, signals, 1, &state);
  EXPECT_EQ(state.on, 1u);
  signals[Signal::lump_edge] = -0.0043;
  detect(s, signals, 2, &state);
  EXPECT_EQ(state.on, 1u);
  signals[Signal::lump_edge] = -0.0045;
  detect(s, signals, 3, &state);
  EXPECT_EQ(state.on, 0u);
}

TEST(Subtasks, AllConditionsMustHoldAndPartsMayOverlap) {
  Subtasks s = one({Signal::floor_contact, Condition::Compare::at_least, 0, {}, 1, 0});
  s.each[0].conditions[1] = {Signal::floor_texture, Condition::Compare::at_least, 0, {}, 1, 0};
  s.each[0].count = 2;
  s.each[1].conditions[0] = {Signal::phase, Condition::Compare::equal, 0, {}, 2, 0};
  s.each[1].count = 1;
  s.count = 2;
  SubtaskState state;
  SignalValues signals;
  signals[Signal::floor_contact] = 1;
  EXPECT_EQ(detect(s, signals, 1, &state), 0u);
  signals[Signal::floor_texture] = 1;
  EXPECT_EQ(detect(s, signals, 2, &state), 1u);
  signals[Signal::phase] = 2;
  EXPECT_EQ(detect(s, signals, 3, &state), 2u);
  EXPECT_EQ(state.on, 3u);
  signals[Signal::floor_contact] = 0;
  detect(s, signals, 4, &state);
  EXPECT_EQ(state.on, 2u);
}

TEST(Subtasks, ASpeedThatTremblesAboutItsThresholdDoesNotChatter) {
  const Subtasks s = one({Signal::floor_speed, Condition::Compare::at_least, 0, {}, 468.75, 0.05});
  SubtaskState state;
  int switches = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t before = state.on;
    detect(s, speed(468.75 * (1 + (i % 2 ? 0.02 : -0.02))), i, &state);
    switches += before != state.on;
  }
  EXPECT_EQ(switches, 1);
}

TEST(Signals, EveryOneHasANameOfItsOwn) {
  std::set<std::string> names;
  for (int i = 0; i < kSignals; ++i)
    EXPECT_TRUE(names.insert(signalName(static_cast<Signal>(i)).name).second) << i;
  EXPECT_EQ(signalName(static_cast<Signal>(200)).name, std::string("none"));
}

}  // namespace
}  // namespace palpa::haptics

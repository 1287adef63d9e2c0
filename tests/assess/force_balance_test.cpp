#include "apps/assess/force_balance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace palpa::assess {
namespace {

constexpr double kMass = 0.05, kTick = 1e-3;
constexpr int kLate = 5;  // ticks

double wayAt(double t) { return 0.01 * std::sin(12 * t); }
double objectAt(double t) { return 0.5 * (1 - std::cos(3 * t)); }

/// A tool that obeys Newton: a reaction that comes late, its sign and scale as given; the hand does
/// the rest.
std::vector<haptics::FlightRecord> recorded(double sign, double scale) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0, 0.01);
  std::vector<haptics::FlightRecord> ticks;
  for (int i = 0; i < 3000; ++i) {
    const double t = i * kTick, late = (i - kLate) * kTick, acceleration = -144 * wayAt(t);
    haptics::FlightRecord r;
    r.tick = i;
    r.t_ns = 1'000'000LL * i;
    r.reading.homed = r.reading.instrumented = 1;
    r.reading.p_DE = {0, 0, 23e-6 * std::round(wayAt(t) / 23e-6)};
    r.reading.f_device_D = {noise(random), 0, 0.2 + noise(random)};
    r.reading.f_hand_D = {0, noise(random),
                          kMass * acceleration - 0.2 - objectAt(t) + noise(random)};
    r.sensed = {{0, 0, sign * scale * objectAt(late)},
                {0.1, 0, wayAt(late)},
                haptics::SensorState::valid,
                {}};
    ticks.push_back(r);
  }
  return ticks;
}

TEST(ForceBalance, WhatAddsUpIsWithinTheNoise) {
  const ForceBalance balance = balanceOf(recorded(1, 1), kMass);
  EXPECT_GT(balance.samples, 2900u);
  EXPECT_LT(balance.largest_N, 0.025);
  EXPECT_NEAR(balance.object_N, 1, 0.02);
  EXPECT_NEAR(balance.delay_s, kLate * kTick, 1e-9);
}

TEST(ForceBalance, AWrongSignAWrongScaleAndAWrongMassAreSeen) {
  EXPECT_GT(balanceOf(recorded(-1, 1), kMass).largest_N, 1.9);
  EXPECT_GT(balanceOf(recorded(1, 1.1), kMass).largest_N, 0.09);
  EXPECT_GT(balanceOf(recorded(1, 1), 2 * kMass).largest_N, 0.06);
}

TEST(ForceBalance, GapsAndWhatWasNotMeasuredAreLeftOut) {
  std::vector<haptics::FlightRecord> ticks = recorded(1, 1);
  ticks.erase(ticks.begin() + 1000, ticks.begin() + 1500);
  for (std::size_t i = 1000; i < 1100; ++i) ticks[i].sensed.state = haptics::SensorState::unusable;
  const ForceBalance balance = balanceOf(ticks, kMass);
  EXPECT_GT(balance.samples, 2200u);
  EXPECT_LT(balance.largest_N, 0.025);
  for (haptics::FlightRecord& tick : ticks) tick.reading.instrumented = 0;
  EXPECT_EQ(balanceOf(ticks, kMass).samples, 0u);
  EXPECT_EQ(balanceOf({}, kMass).samples, 0u);
}

}  // namespace
}  // namespace palpa::assess

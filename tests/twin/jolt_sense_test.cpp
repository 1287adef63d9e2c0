#include "apps/twin/hand_senses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace palpa::twin {
namespace {

constexpr double kFeltStep = 0.001;  // s
constexpr JoltSense::Limits kNoDoubt{0.002, 2, 0, 0.0005};

JoltSense fingers(const JoltSense::Limits& limits = kNoDoubt, std::uint64_t seed = 1) {
  return {limits, RandomStream(seed, "test.jolts")};
}

/// How many jolts are noticed while the velocity is `v(t)`, m/s.
template <typename Velocity>
int joltsIn(JoltSense& sense, double seconds, Velocity v, double dt = kFeltStep) {
  int jolts = 0;
  for (int i = 0; i < static_cast<int>(seconds / dt + 0.5); ++i) jolts += sense.feel(v(i * dt), dt);
  return jolts;
}

Vec3 still(double) { return Vec3::Zero(); }

auto shaking(double frequency_Hz, double amplitude) {
  return [=](double t) {
    return Vec3(0, amplitude * std::sin(2 * std::numbers::pi * frequency_Hz * t), 0);
  };
}

TEST(JoltSense, AStepOfVelocityIsNoticedOnce) {
  for (const Vec3& way : {Vec3(0.010, 0, 0), Vec3(0, 0, -0.010), Vec3(0.006, 0.008, 0)}) {
    JoltSense sense = fingers();
    EXPECT_EQ(joltsIn(sense, 0.2, still), 0);
    EXPECT_EQ(joltsIn(sense, 0.05, [&](double) { return way; }), 1);
    EXPECT_EQ(joltsIn(sense, 1, [&](double) { return way; }), 0);
  }
}

/// 10 mm/s shake by 3.1 mm/s at 1 kHz, half as much again as the 2 mm/s that are just noticed:
/// hardly ever missed, and no step of 3 mm/s noticed but by chance.
TEST(JoltSense, ItsThresholdScatters) {
  const auto noticed = [](double step) {
    int count = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      JoltSense sense = fingers({0.002, 2, 0.15, 0.0005}, seed);
      count += joltsIn(sense, 0.03, [&](double) { return Vec3(step, 0, 0); }) > 0;
    }
    return count;
  };
  EXPECT_GT(noticed(0.010), 395);
  EXPECT_GT(noticed(0.006), 40);
  EXPECT_LT(noticed(0.006), 360);
  EXPECT_LT(noticed(0.003), 5);
}

TEST(JoltSense, SlowMotionIsNoJolt) {
  JoltSense sense = fingers({0.002, 2, 0.15, 0.0005});
  EXPECT_EQ(joltsIn(sense, 10, shaking(2, 0.020)),
            0);  // shakes by 2 ms x 2 pi 2 Hz x 20 mm/s: 0.5 mm/s
}

/// Of the two low-passes in continuous time, root mean square of A |1 / (1 + i w 1 ms) - 1 / (1 + i
/// w 3 ms)|; steps of 0.05 ms come near to that.
TEST(JoltSense, RoughnessIsTheShakingInProportion) {
  constexpr double kFine = 5e-5, kFloor = 0.0005, kGain = 0.4965;  // at 80 Hz
  const auto roughness = [&](double amplitude) {
    JoltSense sense = fingers();
    joltsIn(sense, 0.1, shaking(80, amplitude), kFine);
    sense.beginStroke();
    joltsIn(sense, 1, shaking(80, amplitude), kFine);
    return sense.roughness();
  };
  EXPECT_EQ(roughness(0), kFloor);
  const auto shakeOf = [&](double amplitude) {
    return std::sqrt(roughness(amplitude) * roughness(amplitude) - kFloor * kFloor);
  };
  for (const double amplitude : {0.001, 0.004, 0.020})
    EXPECT_NEAR(shakeOf(amplitude) / amplitude, kGain / std::sqrt(2), 0.02 * kGain) << amplitude;
  EXPECT_NEAR(shakeOf(0.020) / shakeOf(0.001), 20, 1e-6);
}

TEST(JoltSense, RoughnessIsOfTheStrokeAlone) {
  JoltSense sense = fingers();
  EXPECT_EQ(sense.roughness(), kNoDoubt.rough_floor) << "nothing was felt";
  joltsIn(sense, 1, shaking(80, 0.030));
  EXPECT_GT(sense.roughness(), 5 * kNoDoubt.rough_floor);
  joltsIn(sense, 0.1, still);
  sense.beginStroke();
  joltsIn(sense, 1, still);
  EXPECT_NEAR(sense.roughness(), kNoDoubt.rough_floor, 1e-9);
}

TEST(JoltSense, AtMostOneJoltInTwentyFiveMilliseconds) {
  JoltSense sense = fingers({0.002, 0, 0, 0.0005});  // nobody gets used to it
  int last = -1000, jolts = 0, closest = 1000;
  for (int i = 0; i < 2000; ++i) {
    if (!sense.feel(shaking(80, 0.100)(i * kFeltStep), kFeltStep)) continue;
    if (jolts++ > 0) closest = std::min(closest, i - last);
    last = i;
  }
  EXPECT_GE(closest, 25);
  EXPECT_GT(jolts, 60) << "and hardly fewer: 80 a 2 s are the most";
  EXPECT_LE(jolts, 80);
}

TEST(JoltSense, WhatShakesAllTheTimeRaisesTheThreshold) {
  const auto noticedAfter = [](double amplitude, double contrast) {
    JoltSense sense = fingers({0.002, contrast, 0, 0.0005});
    joltsIn(sense, 3, shaking(80, amplitude));
    joltsIn(sense, 0.1, still);
    return joltsIn(sense, 0.05, [](double) { return Vec3(0.010, 0, 0); });
  };
  EXPECT_EQ(noticedAfter(0, 2), 1);
  EXPECT_EQ(noticedAfter(0.010, 2), 0);
  EXPECT_EQ(noticedAfter(0.010, 0), 1) << "without contrast it would be";
  JoltSense sense = fingers();
  joltsIn(sense, 3, shaking(80, 0.010));
  EXPECT_EQ(joltsIn(sense, 3, shaking(80, 0.010)), 0) << "itself is no jolt any more";
  joltsIn(sense, 5, still);
  EXPECT_EQ(joltsIn(sense, 0.05, [](double) { return Vec3(0.010, 0, 0); }), 1)
      << "after a rest as before";
}

}  // namespace
}  // namespace palpa::twin

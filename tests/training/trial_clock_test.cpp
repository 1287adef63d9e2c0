#include "apps/training/trial_clock.h"

#include <gtest/gtest.h>

namespace palpa::training {
namespace {

constexpr std::int64_t kTick = 1'000'000, kSecond = 1'000'000'000;

/// Ticks of 1 ms from `from_ns`, as many as `count`.
void serve(TrialTimes& times, std::int64_t from_ns, int count, bool armed = true) {
  for (int i = 0; i < count; ++i) times.add(from_ns + i * kTick, armed);
}

TEST(TrialClock, RunsWhileTheDeviceIsArmed) {
  TrialClock clock;
  EXPECT_EQ(clock.pass(5 * kSecond), 0);
  EXPECT_NEAR(clock.pass(5 * kSecond + kTick), 1e-3, 1e-12);
  EXPECT_EQ(clock.pass(5 * kSecond + kTick), 0) << "a second tool's tick";
  clock.pause();
  EXPECT_EQ(clock.pass(5 * kSecond + 2 * kTick), 0);
  EXPECT_EQ(clock.pass(7 * kSecond), 0) << "nobody was served";
  EXPECT_NEAR(clock.pass(7 * kSecond + 100 * kTick), 0.1, 1e-12);
  EXPECT_NEAR(clock.seconds(), 0.101, 1e-12);
}

TEST(TrialTimes, LeavesPausesOut) {
  TrialTimes times;
  serve(times, 10 * kSecond, 2001);        // 2 s
  serve(times, 13 * kSecond, 100, false);  // paused
  serve(times, 20 * kSecond, 1001);        // 1 s
  EXPECT_NEAR(times.length_s(), 3, 1e-9);
  EXPECT_EQ(times.at(9 * kSecond), 0);
  EXPECT_NEAR(times.at(11 * kSecond), 1, 1e-9);
  EXPECT_NEAR(times.at(15 * kSecond), 2, 1e-9) << "in the pause";
  EXPECT_NEAR(times.at(20 * kSecond + kSecond / 2), 2.5, 1e-9);
  EXPECT_NEAR(times.at(90 * kSecond), 3, 1e-9) << "after the trial";
}

TEST(TrialTimes, TwoToolsAreOneTime) {
  TrialTimes times;
  for (int i = 0; i < 1001; ++i) {
    times.add(i * kTick, true);
    times.add(i * kTick, true);
  }
  EXPECT_NEAR(times.length_s(), 1, 1e-9);
  EXPECT_NEAR(times.at(kSecond / 4), 0.25, 1e-9);
}

TEST(TrialTimes, OfNothingIsNothing) {
  TrialTimes times;
  EXPECT_EQ(times.at(kSecond), 0);
  EXPECT_EQ(times.length_s(), 0);
}

}  // namespace
}  // namespace palpa::training

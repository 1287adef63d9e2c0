#include "haptics/safety/safety_limiter.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace palpa::haptics {
namespace {

struct Bench {
  SafetyLimits limits;
  SafetyState state;
  SafetyInput input;
  Bench() {
    input.armed = true;
    input.sequence = 1;
  }
  Vec3 step(const Vec3& f) {
    input.now_ns += 1'000'000;
    ++input.sequence;
    input.f_wanted_D = f;
    return limitForce(limits, state, input);
  }
};

TEST(SafetyLimiter, ClampsMagnitudeAndKeepsDirection) {
  Bench bench;
  Vec3 f;
  for (int i = 0; i < 50; ++i) f = bench.step({30, 40, 0});
  EXPECT_NEAR(f.norm(), bench.limits.max_force_N, 1e-12);
  EXPECT_NEAR(f.normalized().dot(Vec3(0.6, 0.8, 0)), 1, 1e-12);
}

TEST(SafetyLimiter, RisesAreSlewedFallsAreImmediate) {
  Bench bench;
  const double step = bench.limits.max_slew_N_per_s * bench.input.dt;
  EXPECT_NEAR(bench.step({5, 0, 0}).norm(), step, 1e-12);
  EXPECT_EQ(bench.state.cause, SafetyCause::slew);
  bench.step({5, 0, 0});
  bench.step({5, 0, 0});
  EXPECT_NEAR(bench.step({1, 0, 0}).x(), 1, 1e-12);
  EXPECT_NEAR(bench.step({-5, 0, 0}).x(), -step, 1e-12);  // reversal: falls at once, then rises
}

TEST(SafetyLimiter, WarmDrivesGiveWhatTheyCanBearForLong) {
  Bench bench;
  bench.limits.continuous_force_N = 2;
  bench.limits.thermal_tau = 5;
  bench.limits.max_energy_J = 1e9;
  double first_duty_s = 0, heat = 0;
  Vec3 f;
  for (int i = 0; i < 60'000; ++i) {
    f = bench.step({6, 0, 0});
    heat += (f.squaredNorm() - heat) * 1e-3 / 5;  // the same equation, on what came out
    if (bench.state.cause == SafetyCause::duty && first_duty_s == 0) first_duty_s = 1e-3 * i;
  }
  // 6 N are too much from a heat of 4 (0.8 + 0.2 (7.9 - 6) / (7.9 - 2)) = 3.458 on: 36 (1 -
  // exp(-t/5)) at t = 0.505 s.
  EXPECT_NEAR(first_duty_s, 0.505, 0.01);
  EXPECT_EQ(bench.state.cause, SafetyCause::duty);
  EXPECT_GE(f.norm(), 2 - 1e-9);  // never less than what may last
  EXPECT_LT(heat, 4.01);
  EXPECT_NEAR(f.norm(), 2, 0.05);
  for (int i = 0; i < 20'000; ++i) bench.step({0.5, 0, 0});
  EXPECT_EQ(bench.state.cause, SafetyCause::none) << "small forces are never cut";
  for (int i = 0; i < 50; ++i) f = bench.step({6, 0, 0});
  EXPECT_NEAR(f.norm(), 6, 1e-9) << "cool again";
}

TEST(SafetyLimiter, WithoutAnyDataOfItsDrivesADeviceIsNotCut) {
  Bench bench;
  Vec3 f;
  for (int i = 0; i < 100'000; ++i) f = bench.step({6, 0, 0});
  EXPECT_NEAR(f.norm(), 6, 1e-12);
}

TEST(SafetyLimiter, NotFiniteGivesZeroAtOnce) {
  Bench bench;
  bench.step({1, 0, 0});
  const double bad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(bench.step({bad, 0, 0}), Vec3::Zero());
  EXPECT_EQ(bench.state.cause, SafetyCause::not_finite);
  bench.input.p_DE = {0, std::numeric_limits<double>::infinity(), 0};
  EXPECT_EQ(bench.step({1, 0, 0}), Vec3::Zero());
  bench.input.p_DE = Vec3::Zero();
  EXPECT_GT(bench.step({1, 0, 0}).norm(), 0);  // and it recovers
}

TEST(SafetyLimiter, ASilentDeviceGetsNoForce) {
  Bench bench;
  bench.step({1, 0, 0});
  Vec3 f;
  int ticks = 0;
  for (; ticks < 30; ++ticks) {
    bench.input.now_ns += 1'000'000;  // same sequence number: nothing heard
    f = limitForce(bench.limits, bench.state, bench.input);
    if (f.norm() == 0) break;
  }
  EXPECT_EQ(ticks + 1, 10);  // 10 ms
  EXPECT_EQ(bench.state.cause, SafetyCause::silent_device);
}

TEST(SafetyLimiter, EmergencyStopHoldsUntilDisarmedAndArmedAgain) {
  Bench bench;
  bench.step({1, 0, 0});
  bench.input.emergency_stop = true;
  EXPECT_EQ(bench.step({1, 0, 0}), Vec3::Zero());
  bench.input.emergency_stop = false;
  EXPECT_EQ(bench.step({1, 0, 0}), Vec3::Zero());  // releasing the button is not enough
  bench.input.armed = false;
  bench.step({1, 0, 0});
  bench.input.armed = true;
  EXPECT_GT(bench.step({1, 0, 0}).norm(), 0);
}

TEST(SafetyLimiter, NoOtherFaultClearsAStop) {
  Bench bench;
  bench.input.emergency_stop = true;
  bench.step({1, 0, 0});
  bench.input.emergency_stop = false;
  bench.input.p_DE.x() = std::numeric_limits<double>::quiet_NaN();
  bench.step({1, 0, 0});
  bench.input.p_DE.x() = 0;
  EXPECT_EQ(bench.step({1, 0, 0}), Vec3::Zero());
  bench.input.homed = false;
  bench.step({1, 0, 0});
  bench.input.homed = true;
  EXPECT_EQ(bench.step({1, 0, 0}), Vec3::Zero()) << "losing the homing is not disarming";
  EXPECT_EQ(bench.state.cause, SafetyCause::emergency_stop);
}

TEST(SafetyLimiter, TheDeadMansButtonGivesForceOnlyWhileItIsHeld) {
  Bench bench;
  bench.limits.deadman_button = 1u << 2;
  const double step = bench.limits.max_slew_N_per_s * bench.input.dt;
  EXPECT_EQ(bench.step({5, 0, 0}), Vec3::Zero());
  EXPECT_EQ(bench.state.cause, SafetyCause::deadman);
  bench.input.buttons = 1u << 1;
  EXPECT_EQ(bench.step({5, 0, 0}), Vec3::Zero()) << "another button";
  bench.input.buttons = 1u << 2 | 1u;
  EXPECT_NEAR(bench.step({5, 0, 0}).norm(), step, 1e-12) << "back within the slew limit";
  EXPECT_NEAR(bench.step({5, 0, 0}).norm(), 2 * step, 1e-12);
  bench.input.buttons = 1;
  EXPECT_EQ(bench.step({5, 0, 0}), Vec3::Zero()) << "let go: at once";
  bench.limits.deadman_button = 0;
  EXPECT_GT(bench.step({5, 0, 0}).norm(), 0) << "0: off";
}

TEST(SafetyLimiter, EnergyGivenToTheHandIsBounded) {
  Bench bench;
  double given = 0;
  for (int i = 0; i < 3000; ++i) {  // the device drives the hand along: 5 N over 3 m
    const Vec3 f = unpack(bench.state.f_last_D);
    bench.input.p_DE.x() += 0.001;
    given += f.x() * 0.001;
    bench.step({5, 0, 0});
  }
  EXPECT_LE(given, bench.limits.max_energy_J + 5 * 0.001 + 1e-12);  // one more tick's work at most
  EXPECT_EQ(bench.state.cause, SafetyCause::energy);
}

TEST(SafetyLimiter, NothingEverBreaksTheLimits) {
  Bench bench;
  std::mt19937_64 bits(7);
  const auto uniform = [&](double a, double b) {
    return a + (b - a) * static_cast<double>(bits() >> 11) * 0x1p-53;
  };
  const double step = bench.limits.max_slew_N_per_s * bench.input.dt;
  Vec3 last = Vec3::Zero();
  for (int i = 0; i < 100'000; ++i) {
    const double kind = uniform(0, 1);
    bench.input.armed = kind > 0.05;
    bench.input.emergency_stop = kind > 0.99;
    bench.input.p_DE =
        Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) * (kind > 0.98 ? 1e300 : 0.01);
    Vec3 wanted(uniform(-30, 30), uniform(-30, 30), uniform(-30, 30));
    if (kind > 0.96 && kind < 0.97) wanted *= std::numeric_limits<double>::infinity();
    const Vec3 f = bench.step(wanted);
    ASSERT_TRUE(f.allFinite());
    ASSERT_LE(f.norm(), bench.limits.max_force_N * (1 + 1e-12));
    ASSERT_LE(f.norm() - last.norm(), step * (1 + 1e-9));
    last = f;
  }
}

}  // namespace
}  // namespace palpa::haptics

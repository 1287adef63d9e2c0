#include "haptics/modulation/pulse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "haptics/loop/tick.h"

/// A pulse that is not there: the law of one artery under one tool, and that law in the loop.
namespace palpa::haptics {
namespace {

constexpr std::int64_t kBeat_ns = 2'000'000'000;

PulseLaw pulseLaw() {
  PulseLaw law;
  law.waves[0].bumps = {{{0, 0.11, 0.29, 0.97}, {0.09, 0.23, 0.42, 0.4}, {0.26, 0.39, 0.62, 0.28}}};
  return law;
}

/// Along y, 4 mm deep, one beat.
PulsingArtery arteryAlongY() {
  PulsingArtery artery;
  artery.a_P = {0, 1, 0};
  artery.half_length = 0.02;
  artery.depth = 0.004;
  artery.strength_N = 0.3;
  artery.best_N = 0.6;
  artery.vessel = 1;
  artery.beats[0] = {kBeat_ns, 1};
  return artery;
}

/// Held at `place` so hard for long, then felt `t` seconds after the beat's start.
Vec3 pulseFelt(const PulsingArtery& artery, const Vec3& place, double f_n, double t) {
  const PulseLaw law = pulseLaw();
  PulseState state{f_n};
  const PulseTouch touch{true, place, Vec3::UnitZ(), f_n};
  return feelPulse(law, artery, touch, kBeat_ns + std::llround(1e9 * t), 1e-3, &state);
}
double peakAt(const Vec3& place, double f_n) {
  return pulseFelt(arteryAlongY(), place, f_n, 0.12).z();
}

TEST(Pulse, ABeatBeginsAndEndsAtNothingAndNeverJumps) {
  const PulseWave wave = pulseLaw().waves[0];
  double last = 0, largest = 0;
  for (int i = -100; i < 1000; ++i) {
    const double w = pulseWave(wave, 1e-3 * i);
    EXPECT_GE(w, 0);
    EXPECT_LT(std::abs(w - last), 0.03) << i << " ms";  // N a ms of 1 N: within the slew limit
    if (i <= 0 || i >= 620) {
      EXPECT_EQ(w, 0) << i;
    }
    largest = std::max(largest, w);
    last = w;
  }
  EXPECT_NEAR(largest, 1, 0.02);
}

TEST(Pulse, ItIsFeltNearTheLineEquallyOnBothSidesAndNowhereElse) {
  const double above = peakAt(Vec3::Zero(), 0.6);
  EXPECT_GT(above, 0.15);
  EXPECT_NEAR(peakAt({0.003, 0, 0}, 0.6), peakAt({-0.003, 0, 0}, 0.6), 1e-12);
  EXPECT_NEAR(peakAt({0, 0.015, 0}, 0.6), above, 1e-12);  // along it nothing changes
  EXPECT_LT(peakAt({0, 0.03, 0}, 0.6), above);            // beyond its end
  double last = above;
  for (double d = 0.001; d < 0.022; d += 0.001) {
    EXPECT_LT(peakAt({d, 0, 0}, 0.6), last);
    last = peakAt({d, 0, 0}, 0.6);
  }
  EXPECT_EQ(peakAt({0.024, 0, 0}, 0.6), 0);  // 4 sqrt(4^2 + 4^2) mm = 22.6 mm
}

TEST(Pulse, DeeperIsWeakerAndWider) {
  const auto half = [](double z) {
    double d = 0;
    while (pulseAcross(d, z, 0.004) > 0.5 * pulseAcross(0, z, 0.004)) d += 1e-5;
    return d;
  };
  EXPECT_LT(pulseAcross(0, 0.015, 0.004), 0.5 * pulseAcross(0, 0.003, 0.004));
  EXPECT_GT(half(0.015), 2.5 * half(0.003));
  // Flamant's half width, 0.64 of the depth, a little less for the end
  EXPECT_NEAR(half(0.015) / std::hypot(0.015, 0.004), std::sqrt(std::sqrt(2.0) - 1), 0.03);
}

TEST(Pulse, TooLightAndTooHardItIsLost) {
  EXPECT_EQ(pulsePressed(0, 1.58), 0);
  EXPECT_EQ(pulsePressed(1, 1.58), 1);
  EXPECT_NEAR(pulsePressed(1.29, 1.58), 0.5, 1e-12);  // at the systolic pressure
  EXPECT_EQ(pulsePressed(1.6, 1.58), 0);
  const double best = peakAt(Vec3::Zero(), 0.6);
  EXPECT_LT(peakAt(Vec3::Zero(), 0.25), 0.6 * best);
  EXPECT_LT(peakAt(Vec3::Zero(), 0.85), 0.4 * best);
  EXPECT_EQ(peakAt(Vec3::Zero(), 1.0), 0);
  for (double u = 0; u < 2; u += 1e-3)
    EXPECT_LT(std::abs(pulsePressed(u + 1e-3, 1.58) - pulsePressed(u, 1.58)), 0.003);
}

TEST(Pulse, ABeatIsAsStrongAsItIsSaidAndTwoAddUp) {
  PulsingArtery artery = arteryAlongY();
  const double once = pulseFelt(artery, Vec3::Zero(), 0.6, 0.35).z();
  artery.beats[1] = {kBeat_ns + 250'000'000, 0.5};
  const double both = pulseFelt(artery, Vec3::Zero(), 0.6, 0.35).z();
  artery.beats[0].strength = 0;
  EXPECT_NEAR(both, once + pulseFelt(artery, Vec3::Zero(), 0.6, 0.35).z(), 1e-12);
  artery.beats[1].strength = 100;
  EXPECT_EQ(pulseFelt(artery, Vec3::Zero(), 0.6, 0.35).z(), pulseLaw().largest_N);
}

/// The mean pressure decides: a pulse that lifts the tool does not pinch itself off.
TEST(Pulse, APressureIsKnownAfterAMoment) {
  const PulseLaw law = pulseLaw();
  PulseState state;
  const PulseTouch touch{true, Vec3::Zero(), Vec3::UnitZ(), 0.6};
  for (int i = 0; i < 300; ++i) feelPulse(law, arteryAlongY(), touch, 0, 1e-3, &state);
  EXPECT_NEAR(state.pressed_N, 0.6 * (1 - std::exp(-1)), 0.01);
}

TEST(Pulse, WithoutContactOrForInvalidFiguresThereIsNone) {
  const PulseLaw law = pulseLaw();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PulseState state{0.6};
  const std::int64_t at = kBeat_ns + 120'000'000;
  EXPECT_EQ(
      feelPulse(law, arteryAlongY(), {false, Vec3::Zero(), Vec3::UnitZ(), 0.6}, at, 1e-3, &state)
          .norm(),
      0);
  EXPECT_EQ(state.pressed_N, 0);
  for (const auto& spoil : std::vector<std::function<void(PulsingArtery&)>>{
           [](PulsingArtery& a) { a.vessel = 0; }, [](PulsingArtery& a) { a.vessel = 4; },
           [nan](PulsingArtery& a) { a.p_P[0] = nan; }, [](PulsingArtery& a) { a.a_P = {}; },
           [nan](PulsingArtery& a) { a.strength_N = nan; },
           [nan](PulsingArtery& a) { a.depth = nan; }, [](PulsingArtery& a) { a.best_N = 0; },
           [nan](PulsingArtery& a) { a.beats[0].strength = nan; },
           [](PulsingArtery& a) { a.beats[0].start_ns = std::int64_t{1} << 62; }}) {
    PulsingArtery artery = arteryAlongY();
    spoil(artery);
    EXPECT_EQ(pulseFelt(artery, Vec3::Zero(), 0.6, 0.12).norm(), 0);
  }
}

/// In the loop: pressed on a real thing, sensed without noise.
struct PulseLoop {
  TickConfig config;
  TickCommands commands;
  TickState state;
  std::int64_t now = 0;
  std::uint64_t readings = 0;

  PulseLoop() {
    config.contact_mode = ContactMode::sensed_object;
    config.object_at_port = 1;
    config.touch.surface.contact = {{900, 200, 1.4}, 0, {0.35, 1500, 0.4}, {}, 0.1};
    config.touch.tip_radius = 0.008;
    config.pulse = pulseLaw();
    config.X_DP = pack(
        makePose(Eigen::AngleAxisd(0.7, Vec3::UnitX()).toRotationMatrix(), Vec3(0.1, 0, -0.2)));
    commands.armed = 1;
    commands.trial = 1;
    commands.artery = arteryAlongY();
  }
  FlightRecord step(double f_n) {
    const Pose X_DP = unpack(config.X_DP);
    const Vec3 tip(0, 0, -0.002);
    DeviceReading reading;
    reading.t_ns = now += 1'000'000;
    reading.sequence = ++readings;
    reading.homed = 1;
    reading.p_DE = pack(Vec3(X_DP * tip));
    const SensedForce sensed{pack(Vec3(X_DP.linear() * Vec3(0, 0, f_n))),
                             pack(Vec3(X_DP * (tip + 0.008 * Vec3::UnitZ()))),
                             SensorState::valid,
                             {}};
    return tick(config, state, reading, nullptr, commands, now, sensed);
  }
  FlightRecord until(std::int64_t t_ns, double f_n) {
    FlightRecord last;
    while (now < t_ns) last = step(f_n);
    return last;
  }
};

TEST(PulseTick, TheToolIsPushedOutwardByWhatTheLawSays) {
  PulseLoop loop;
  const FlightRecord before = loop.until(kBeat_ns - 1'000'000, 0.6),
                     at = loop.until(kBeat_ns + 120'000'000, 0.6);
  EXPECT_LT(unpack(before.f_augmentation_D).norm(), 1e-12);
  const Vec3 up_D = unpack(loop.config.X_DP).linear() * Vec3::UnitZ();
  const double wanted = pulseFelt(arteryAlongY(), Vec3::Zero(), 0.6, 0.12).z();
  EXPECT_NEAR((unpack(at.f_augmentation_D) - wanted * up_D).norm(), 0, 0.01 * wanted);
  EXPECT_NEAR((unpack(at.f_command_D) - wanted * up_D).norm(), 0, 0.01 * wanted);
  EXPECT_EQ(at.damped, 0);  // a source: it owes no energy
  EXPECT_LT(unpack(at.f_contact_D).norm(), 1e-9);
}

TEST(PulseTick, LiftedOrDisarmedThereIsNoPulse) {
  PulseLoop loop;
  loop.until(kBeat_ns + 120'000'000, 0.6);
  EXPECT_EQ(unpack(loop.step(0).f_augmentation_D).norm(), 0);
  EXPECT_EQ(loop.state.pulse.pressed_N, 0);
  loop.until(loop.now + 5'000'000, 0.6);
  loop.commands.armed = 0;
  EXPECT_EQ(unpack(loop.step(0.6).f_command_D).norm(), 0);
  loop.commands.trial = 2;
  loop.step(0.6);
  EXPECT_LT(loop.state.pulse.pressed_N, 0.1);  // begins anew
}

/// From a copied state, as a replay begins at a keyframe.
TEST(PulseTick, ARunGoesOnFromAKeyframeBitForBit) {
  PulseLoop first;
  first.until(kBeat_ns + 50'000'000, 0.6);
  PulseLoop second = first;
  for (int i = 0; i < 200; ++i) {
    const double f_n = 0.6 + 0.02 * (i % 7);
    const FlightRecord a = first.step(f_n), b = second.step(f_n);
    EXPECT_EQ(a.f_command_D, b.f_command_D);
    EXPECT_EQ(a.f_augmentation_D, b.f_augmentation_D);
  }
}

}  // namespace
}  // namespace palpa::haptics

#include "haptics/safety/passivity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpa::haptics {
namespace {

constexpr double kPeriod = 1e-3, kEncoderStep = 23e-6;

/// A free mass that falls on a stiff wall and is pushed against it; the wall's force is held for a
/// period, as every sampled wall's is. x > 0 is inside.
struct Drop {
  double mass = 0.1, preload_N = 1, height = 1e-3, wall = 5250, damping = 0;
  bool controlled = true;
  int ticks_a_reading = 1;  ///< a loop faster than its device sees each reading so often

  double highest_rebound = 0, first_rebound = 0, last_rebound = 0;
  double energy_J = 0, least_energy_J = 0;  ///< of the controller, from the true motion
  double last_low = 1, last_high = -1;      ///< of the last tenth of a second

  void run(double seconds) {
    PassivityLimits limits;
    if (controlled) limits.max_damping = 0.2 * mass / kPeriod;
    PassivityState state;
    double x = -height, v = 0, before, peak = 0;
    bool inside = false;
    const int ticks = int(seconds / kPeriod);
    for (int k = 0; k < ticks; ++k) {
      const double seen = std::round(x / kEncoderStep) * kEncoderStep;
      PassivityInput in;
      in.p_DE = {seen, 0, 0};
      in.f_D = {seen > 0 ? -wall * seen : 0.0, 0, 0};
      in.dt = kPeriod / ticks_a_reading;
      double f = keepPassive(limits, state, in).x();
      in.fresh = false;  // the same reading again, in the loop's further ticks
      in.dt = kPeriod / ticks_a_reading;
      for (int i = 1; i < ticks_a_reading; ++i) f = keepPassive(limits, state, in).x();
      before = x;
      constexpr int kSubsteps = 50;
      for (int i = 0; i < kSubsteps; ++i) {
        v += (f + preload_N - damping * v) / mass * kPeriod / kSubsteps;
        x += v * kPeriod / kSubsteps;
      }
      energy_J -= f * (x - before);
      least_energy_J = std::min(least_energy_J, energy_J);
      if (x > 0) inside = true;
      if (inside && x < 0) peak = std::max(peak, -x);
      if (x > 0 && peak > 0) note(peak), peak = 0;
      if (k > ticks - 100) last_low = std::min(last_low, x), last_high = std::max(last_high, x);
    }
    if (peak > 0) note(peak);
  }
  void note(double peak) {
    if (first_rebound == 0) first_rebound = peak;
    last_rebound = peak;
    highest_rebound = std::max(highest_rebound, peak);
  }
};

TEST(Passivity, WithoutControlASampledWallThrowsBackEverHigher) {
  Drop drop;
  drop.controlled = false;
  drop.run(1);
  EXPECT_GT(drop.first_rebound, drop.height);
  EXPECT_GT(drop.last_rebound, 5 * drop.first_rebound);
  EXPECT_LT(drop.least_energy_J, -5e-3);
}

TEST(Passivity, WithControlNoReboundExceedsTheDropAndNoEnergyIsMade) {
  Drop drop;
  drop.run(3);
  EXPECT_GT(drop.highest_rebound, 0);  // it did bounce
  EXPECT_LE(drop.highest_rebound, drop.height);
  EXPECT_GT(drop.least_energy_J, -1e-3);
}

TEST(Passivity, ALoopFourTimesAsFastAsItsDeviceIsAsSafe) {
  Drop drop;
  drop.ticks_a_reading = 4;
  drop.run(3);
  EXPECT_GT(drop.highest_rebound, 0);
  EXPECT_LE(drop.highest_rebound, drop.height);
  EXPECT_GT(drop.least_energy_J, -1e-3);
}

TEST(Passivity, OtherMassesPreloadsAndWallsStayBelowTheDropToo) {
  for (const double mass : {0.05, 0.1, 0.3})
    for (const double preload : {0.5, 1.0, 3.0})
      for (const double wall : {1000.0, 3000.0, 5250.0}) {
        if (wall * kPeriod * kPeriod / mass > 0.06) continue;  // beyond what one period can brake
        Drop drop;
        drop.mass = mass, drop.preload_N = preload, drop.wall = wall;
        drop.run(2);
        // The energy that nobody feels, and one encoder step, are allowed for.
        const double allowed = drop.height + PassivityLimits{}.unfelt_J / preload + kEncoderStep;
        EXPECT_LE(drop.highest_rebound, allowed) << mass << " " << preload << " " << wall;
        EXPECT_GT(drop.least_energy_J, -1e-3) << mass << " " << preload << " " << wall;
      }
}

TEST(Passivity, WithDampingItComesToRest) {
  Drop drop;
  drop.damping = 5;
  drop.run(1.1);
  EXPECT_LE(drop.last_high - drop.last_low, 2 * kEncoderStep);
  EXPECT_NEAR((drop.last_high + drop.last_low) / 2, drop.preload_N / drop.wall, 2 * kEncoderStep);
}

/// Even an ideal spring makes K T v^2 / 2 of power when its force is held for a period; taking just
/// that away needs a damping of K T / 2, which nobody feels.
TEST(Passivity, ASpringThatAHandCanHoldIsAsGoodAsUntouched) {
  PassivityLimits limits;
  limits.max_damping = 20;
  PassivityState state;
  const double amplitude = 2e-3, omega = 2 * M_PI * 0.5, stiffness = 500;
  for (int k = 0; k < 5000; ++k) {
    PassivityInput in;
    in.p_DE = {amplitude * std::sin(omega * k * kPeriod), 0, 0};
    in.f_D = {-stiffness * std::max(in.p_DE.x(), 0.0), 0, 0};
    const double changed = (keepPassive(limits, state, in) - in.f_D).norm();
    ASSERT_LE(changed, 3 * stiffness * kPeriod / 2 * amplitude * omega) << k;
  }
}

TEST(Passivity, AHeldSpringGivesBackWhatItHoldsAfterALongTime) {
  PassivityLimits limits;
  limits.max_damping = 20;
  PassivityState state;
  double most = 0;
  for (int k = 0; k < 12'000; ++k) {  // in within a second, held for ten, out within a second
    const double x = 3e-3 * std::min({k * 1e-3, 1.0, (12'000 - k) * 1e-3});
    PassivityInput in;
    in.p_DE = {x, 0, 0};
    in.f_D = {-1000 * x, 0, 0};
    most = std::max(most, (keepPassive(limits, state, in) - in.f_D).norm());
  }
  EXPECT_EQ(most, 0);
}

/// Taking half of a real spring away makes the device alone active, but not what the hand holds.
TEST(Passivity, SofteningARealObjectIsNotMistakenForInstability) {
  const auto strongest = [](bool told) {
    PassivityLimits limits;
    limits.max_damping = 20;
    PassivityState state;
    double most = 0;
    for (int k = 0; k < 4000; ++k) {
      const double t = k * kPeriod;
      PassivityInput in;
      in.p_DE = {1e-3 * (1 - std::cos(2 * M_PI * t)), 0, 0};
      const double v = 2e-3 * M_PI * std::sin(2 * M_PI * t);
      in.f_D = {300 * in.p_DE.x(), 0, 0};
      if (told) in.f_object_D = {-(600 * in.p_DE.x() + 2 * v), 0, 0};  // takes energy itself
      most = std::max(most, (keepPassive(limits, state, in) - in.f_D).norm());
    }
    return most;
  };
  EXPECT_LT(strongest(true), 1e-3);
  EXPECT_GT(strongest(false), 0.05);
}

TEST(Passivity, ASourceMayGiveItsWorkAway) {
  const auto injected = [](bool told) {
    PassivityLimits limits;
    limits.max_damping = 20;
    PassivityState state;
    int count = 0;
    for (int k = 0; k < 10; ++k) {
      PassivityInput in;
      in.p_DE = {1e-4 * k, 0, 0};
      in.f_D = {2, 0, 0};  // pushes along with the motion: 2 N over 1 mm
      if (told) in.f_source_D = in.f_D;
      keepPassive(limits, state, in);
      count += state.injecting;
    }
    return count;
  };
  EXPECT_EQ(injected(true), 0);
  EXPECT_GT(injected(false), 5);
}

/// A hand that goes to and fro, a pulse along its way or against it, free air, then a wall: without
/// the pulse and with it nothing is added, and the wall's account is the same.
TEST(Passivity, ASourceLeavesNeitherDebtNorCredit) {
  PassivityLimits limits;
  limits.max_damping = 20;
  const auto goneThrough = [&](double pulse_N) {
    PassivityState state;
    for (int k = 0; k < 400; ++k) {
      PassivityInput in;
      in.p_DE = {1e-3 * std::sin(0.05 * k), 0, 0};
      if (k >= 20 && k < 40) in.f_source_D = in.f_D = {pulse_N, 0, 0};
      if (k >= 200) in.f_D = {-100 * std::max(0.0, in.p_DE.x()), 0, 0};
      EXPECT_EQ(keepPassive(limits, state, in), in.f_D) << pulse_N << " N, tick " << k;
    }
    return state;
  };
  const PassivityState without = goneThrough(0);
  for (const double pulse_N : {0.8, -0.8, 5.0, -5.0})
    EXPECT_EQ(goneThrough(pulse_N).energy_J, without.energy_J) << pulse_N;
}

TEST(Passivity, WhatIsNotANumberStartsAnew) {
  PassivityLimits limits;
  limits.max_damping = 20;
  PassivityState state;
  PassivityInput in;
  in.p_DE = {std::nan(""), 0, 0};
  keepPassive(limits, state, in);
  in.p_DE = {1, 0, 0};
  in.f_D = {1, 0, 0};
  EXPECT_EQ(keepPassive(limits, state, in), in.f_D);
  EXPECT_TRUE(std::isfinite(state.energy_J));
}

TEST(VirtualCoupling, IsSizedFromTheDevicesData) {
  DeviceCapabilities device;
  device.viscous_damping = 0.2;
  EXPECT_NEAR(couplingStiffness(device, 1e-3), 2 * 2.2 / 1e-3, 1e-9);
  EXPECT_NEAR(couplingStiffness(device, 0.25e-3), 2 * 2.2 / 0.25e-3, 1e-9);
  EXPECT_NEAR(couplingStiffness(device, 1e-3, 0.7), 2 * 1.5 / 1e-3, 1e-9);
  device.coulomb_friction = 0.03;
  device.position_resolution = 30e-6;
  EXPECT_NEAR(couplingStiffness(device, 1e-3), 2000, 1e-9);
  device.stable_stiffness = 1000;
  EXPECT_NEAR(couplingStiffness(device, 1e-3), 1000, 1e-9);
  EXPECT_EQ(couplingStiffness(device, 1e-3, 5), 0);
  EXPECT_EQ(couplingStiffness({}, 0), 0);
}

}  // namespace
}  // namespace palpa::haptics

#include "haptics/modulation/estimated_reaction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "haptics/loop/tick.h"
#include "tests/support/allocation_count.h"

/// A finger without a force sensor beside a tool that has one, or opposite it.
namespace palpa::haptics {
namespace {

constexpr double kFingerTip = 0.008, kFingerStep = 1e-3;  // m, s
const StiffnessModulation kSoftFace{{900, 5, 1.4}, 1e-4, {0.35, 1500, 0.2}, {}, 0.1};

double pressedBy(double x) { return forceOf(kSoftFace.real, x - kSoftFace.x0, 0); }

/// The first tool's tip so deep, with the reaction that belongs to `felt` m.
ToolTouch firstAt(double z, double felt) {
  return {true, {0.01, 0, z + kFingerTip}, {0, 0, pressedBy(felt)}};
}

EstimatedReaction heldStill(const SecondFace& face, const ToolTouch& first, const Vec3& p_M,
                            EstimateState* state) {
  EstimatedReaction told;
  for (int i = 0; i < 300; ++i)
    told =
        estimateReaction({kSoftFace, kSoftFace}, face, kFingerTip, first, p_M, kFingerStep, state);
  return told;
}

/// The phantom lies 0.6 mm lower than it is thought to: the first tool's reaction tells.
TEST(EstimatedReaction, BesideTheFirstItsReactionTellsWhereTheFaceLies) {
  constexpr double kLower = 0.6e-3;
  EstimateState state;
  const Vec3 p_M(-0.01, 0, kFingerTip - kLower - 4e-3);
  const EstimatedReaction told = heldStill({}, firstAt(-kLower - 3e-3, 3e-3), p_M, &state);
  EXPECT_NEAR(told.x, 4e-3, 0.02e-3);
  EXPECT_NEAR(told.f_r.z(), pressedBy(4e-3), 0.02 * pressedBy(4e-3));
  EXPECT_LT(told.f_r.head<2>().norm(), 1e-9) << "nothing slides";
  EstimateState alone;
  const EstimatedReaction guessed = heldStill({}, {}, p_M, &alone);
  EXPECT_NEAR(guessed.x, 4e-3 + kLower, 1e-9) << "without the first, where it is thought to lie";
}

/// A slab that has moved as a whole by 0.8 mm: what the first does not take up the second does.
TEST(EstimatedReaction, OppositeTheFirstTheSlabMayMove) {
  constexpr double kThick = 0.03, kMoved = 0.8e-3;
  EstimateState state;
  const EstimatedReaction told = heldStill({true, kThick}, firstAt(-5e-3 - kMoved, 5e-3),
                                           {0.01, 0, -kThick + 3e-3 - kMoved - kFingerTip}, &state);
  EXPECT_NEAR(told.x, 3e-3, 1e-9);
  EXPECT_NEAR(told.f_r.z(), -pressedBy(3e-3), 1e-9) << "it is pushed down";
}

TEST(EstimatedReaction, SlidingRubsAgainstTheMotionAndInTheAirThereIsNothing) {
  EstimateState state;
  Vec3 p_M(0, 0, kFingerTip - 4e-3);
  heldStill({}, {}, p_M, &state);
  EstimatedReaction told;
  for (int i = 0; i < 300; ++i) {
    p_M.x() += 5e-5;
    told = estimateReaction({kSoftFace, kSoftFace}, {}, kFingerTip, {}, p_M, kFingerStep, &state);
  }
  EXPECT_NEAR(told.f_r.x(), -0.35 * told.f_r.z() - 0.2 * 0.05, 1e-3);
  EXPECT_EQ(heldStill({}, {}, {0, 0, kFingerTip + 1e-3}, &state).f_r, Vec3(Vec3::Zero()));
  p_M.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(
      estimateReaction({kSoftFace, kSoftFace}, {}, kFingerTip, {}, p_M, kFingerStep, &state).f_r,
      Vec3(Vec3::Zero()));
  EXPECT_EQ(state.held, 0u);
}

/// A tool with a sensor, and a tracked finger beside it, over a lump between them.
struct TrackedPair {
  PairConfig config;
  PairState state;
  TickCommands commands;
  std::int64_t now = 0;

  TrackedPair() {
    for (TickConfig& tool : config.tools) {
      tool.contact_mode = ContactMode::sensed_object;
      tool.object_at_port = 1;
      tool.touch.surface.contact = kSoftFace;
      tool.touch.kinds[0] = {
          0.014,
          {8000, 0, 1.9},
          {HuntCrossley{600, 0, 1}, HuntCrossley{600, 0, 1}, HuntCrossley{300, 0, 1.1}}};
      tool.touch.tip_radius = kFingerTip;
      tool.X_ET = pack(makePose(Mat3::Identity(), Vec3(0, 0, kFingerTip)));
    }
    config.estimated = 1;
    commands.armed = 1;
    commands.lumps[0] = {{0, 0, -0.014}, 1};
  }
  /// Tips so deep, m; `said`: what the second's missing sensor says.
  std::array<FlightRecord, 2> step(double first, double second, const SensedForce& said = {}) {
    now += 1'000'000;
    const std::array<Vec3, 2> p{Vec3(0.01, 0, kFingerTip - first),
                                Vec3(-0.01, 0, kFingerTip - second)};
    std::array<DeviceReading, 2> readings;
    for (std::size_t t = 0; t < 2; ++t) {
      readings[t].t_ns = now;
      readings[t].sequence = static_cast<std::uint64_t>(now / 1'000'000);
      readings[t].homed = 1;
      readings[t].p_DE = pack(p[t]);
    }
    SensedForce felt{pack(Vec3(0, 0, pressedBy(first))), pack(p[0]), SensorState::valid, {}};
    return tickPair(config, state, readings, commands, now, {felt, said});
  }
  std::array<FlightRecord, 2> press(double first, double second) {
    std::array<FlightRecord, 2> last;
    for (int i = 0; i <= 500; ++i) last = step(first * i / 500, second * i / 500);
    const NoAllocation none;
    for (int i = 0; i < 200; ++i) last = step(first, second);
    return last;
  }
};

TEST(TickPair, ATrackedFingerIsFeltByEstimateAndGivenNoForce) {
  TrackedPair pair;
  const std::array<FlightRecord, 2> both = pair.press(5e-3, 5e-3);
  EXPECT_EQ(both[1].sensed.state, SensorState::estimated);
  EXPECT_NEAR(both[1].sensed.f_D[2], pressedBy(5e-3), 0.03 * pressedBy(5e-3));
  EXPECT_GT(unpack(both[1].f_contact_D).norm(), 0.02) << "the lump presses on it";
  EXPECT_EQ(both[1].f_command_D, Packed3{}) << "but nothing can push it";
  EXPECT_GT(unpack(both[0].f_command_D).norm(), 0.02);
  TrackedPair alone;
  const std::array<FlightRecord, 2> one = alone.press(5e-3, -5e-3);
  EXPECT_GT((unpack(both[0].f_contact_D) - unpack(one[0].f_contact_D)).norm(), 5e-3)
      << "the finger holds the lump toward the tool";
}

TEST(TickPair, WhatAMissingSensorSaysDoesNotCountAndTheSameBitsComeAgain) {
  TrackedPair pair, again;
  for (int i = 0; i < 400; ++i) {
    const double depth = 1e-5 * i;
    const std::array<FlightRecord, 2> told = pair.step(depth, depth);
    const std::array<FlightRecord, 2> same =
        again.step(depth, depth, {{9, 9, 9}, {1, 1, 1}, SensorState::valid, {}});
    EXPECT_EQ(told[1].sensed.f_D, same[1].sensed.f_D) << i;
    EXPECT_EQ(told[0].f_command_D, same[0].f_command_D) << i;
  }
}

}  // namespace
}  // namespace palpa::haptics

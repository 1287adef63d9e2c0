#include "haptics/modulation/learnt_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "haptics/loop/tick.h"
#include "tests/support/allocation_count.h"

/// A real object that is not the same everywhere, and a map of it in the tick.
namespace palpa::haptics {
namespace {

/// 4 x 3 nodes 10 mm apart from (-15, -10) mm on: stiffer toward +x, rougher toward +y.
LearntMap slopingMap() {
  LearntMap map;
  map.columns = 4;
  map.rows = 3;
  map.low_x = -0.015F;
  map.low_y = -0.01F;
  map.step_x = map.step_y = 0.01F;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column) {
      map.stiffness[row * 4 + column] = 0.5F + 0.5F * static_cast<float>(column);
      map.friction[row * 4 + column] = 1.0F + 0.25F * static_cast<float>(row);
    }
  return map;
}

TEST(LearntMap, IsLinearBetweenItsNodesAndTheLawOutside) {
  const LearntMap map = slopingMap();
  for (const double x : {-0.015, -0.012, 0.0, 0.0071, 0.015})
    for (const double y : {-0.01, 0.0, 0.004, 0.01}) {
      const MappedPlace here = placeOn(map, x, y);
      EXPECT_NEAR(here.stiffness, 0.5 + 50 * (x + 0.015), 1e-6) << x;
      EXPECT_NEAR(here.friction, 1 + 25 * (y + 0.01), 1e-6) << y;
    }
  for (const auto& [x, y] : {std::pair(0.03, 0.0), std::pair(0.0, -0.0201), std::pair(-1.0, 1.0)}) {
    EXPECT_EQ(placeOn(map, x, y).stiffness, 1);
    EXPECT_EQ(placeOn(map, x, y).friction, 1);
  }
  EXPECT_EQ(placeOn({}, 0, 0).stiffness, 1) << "there is no map";
}

/// A tool that slides off the map, along its edges and over its corners: no step of 10 um changes
/// the law by more than the map's own slope does, and half a step beyond half of it is left.
TEST(LearntMap, FadesBeyondItsRimWithoutAJump) {
  const LearntMap map = slopingMap();
  EXPECT_NEAR(placeOn(map, 0.02, 0).stiffness, 1 + 0.5 * (2 - 1), 1e-5);
  for (const double slope : {0.0, 0.3, 0.8, 2.0}) {
    double before = 1;
    for (double x = -0.06; x < 0.06; x += 1e-5) {
      const double now = placeOn(map, x, slope * x).stiffness;
      EXPECT_LT(std::abs(now - before), 3e-3) << x << ", " << slope;
      before = now;
    }
  }
}

TEST(LearntMap, WhatIsNoNumberLeavesTheLaw) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  LearntMap map = slopingMap();
  const NoAllocation none;
  EXPECT_EQ(placeOn(map, kNone, 0).stiffness, 1);
  EXPECT_EQ(placeOn(map, 0, std::numeric_limits<double>::infinity()).friction, 1);
  map.stiffness[5] = std::numeric_limits<float>::quiet_NaN();
  map.friction[5] = -3;
  const MappedPlace at_node = placeOn(map, -0.005, 0);
  EXPECT_EQ(at_node.stiffness, 1);
  EXPECT_EQ(at_node.friction, 1);
  map = slopingMap();
  map.columns = 4000;  // a damaged record
  EXPECT_EQ(placeOn(map, 0, 0).stiffness, 1);
  EXPECT_EQ(none.allocations(), 0);
}

const HuntCrossley kMappedThing{900, 200, 1.4};

/// Pressed slowly at x to 4 mm where it is as hard as the map says, to be felt as 400 N/m
/// everywhere; what is felt there, N.
double feltAt(double x, bool with_map) {
  TickConfig config;
  config.contact_mode = ContactMode::sensed_object;
  config.object_at_port = 1;
  config.touch.surface.contact = {kMappedThing, 0, {0.35, 1500, 0.4}, {}, 0.05};
  config.touch.surface.contact.target.constant = 400;
  config.touch.tip_radius = 0.008;
  if (with_map) config.touch.map = slopingMap();
  TickCommands commands;
  commands.armed = 1;
  TickState state;
  double felt = 0;
  std::uint64_t number = 0;
  const NoAllocation none;
  for (double depth = -1e-3; depth < 4e-3; depth += 1e-5) {
    DeviceReading reading;
    reading.t_ns = static_cast<std::int64_t>(++number) * 1'000'000;
    reading.sequence = number;
    reading.homed = 1;
    reading.p_DE = {x, 0, -depth};
    const double f = placeOn(slopingMap(), x, 0).stiffness *
                     forceOf(kMappedThing, std::max(depth, 0.0), depth > 0 ? 0.01 : 0);
    const SensedForce sensed{{0, 0, f}, {x, 0, 0.008 - depth}, SensorState::valid, {}};
    felt = f + tick(config, state, reading, nullptr, commands, reading.t_ns, sensed).f_command_D[2];
  }
  EXPECT_EQ(none.allocations(), 0);
  return felt;
}

/// Without the map the law takes a hard place for one that is pressed deep, and a soft one for one
/// that is hardly touched.
TEST(LearntMap, TheTickFeelsTheTargetWhereverTheObjectIsHarder) {
  constexpr double kTarget_N = 400 * 4e-3;
  for (const double x : {-0.013, -0.004, 0.011}) {
    EXPECT_NEAR(feltAt(x, true), kTarget_N, 0.01 * kTarget_N) << x;
    const double hard = placeOn(slopingMap(), x, 0).stiffness;
    EXPECT_NEAR(feltAt(x, false), kTarget_N * std::pow(hard, 1 / kMappedThing.m), 0.02 * kTarget_N)
        << x;
  }
}

}  // namespace
}  // namespace palpa::haptics

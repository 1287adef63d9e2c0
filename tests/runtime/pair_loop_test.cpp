#include <gtest/gtest.h>

#include "apps/runtime/clock.h"
#include "apps/runtime/device_adapters.h"
#include "apps/runtime/haptic_activity.h"
#include "tests/support/allocation_count.h"

/// Two devices and their sensors through one activity, as the haptic thread runs it.
namespace palpa::runtime {
namespace {

const haptics::HuntCrossley kSides{900, 0, 1.4};
constexpr double kHalf = 0.03, kTip = 0.008;

haptics::PairConfig squeezing() {
  haptics::PairConfig config;
  config.squeezing = true;
  config.squeeze.real = kSides;
  for (haptics::TickConfig& tool : config.tools) {
    tool.contact_mode = haptics::ContactMode::sensed_object;
    tool.object_at_port = 1;
    tool.touch.surface.contact = {kSides, 0, {0.35, 1500, 0}, {}, 0.1};
    tool.touch.tip_radius = kTip;
  }
  return config;
}

/// Two hands hold a soft thing between their fingers; each finger has its own device and sensor.
struct HeldThing {
  Bus bus{TimeMode::real};
  std::array<ChannelDevice, 2> devices{ChannelDevice({}, TimeMode::real),
                                       ChannelDevice({}, TimeMode::real)};
  std::array<ChannelSensor, 2> sensors{ChannelSensor({}, TimeMode::real),
                                       ChannelSensor({}, TimeMode::real)};
  std::array<ForceSensing, 2> sensing{ForceSensing(sensors[0], {}), ForceSensing(sensors[1], {})};
  HapticPairActivity haptic{
      bus, {{{devices[0], &sensing[0]}, {devices[1], &sensing[1]}}}, squeezing()};
  std::array<bool, 2> silent{false, false};
  std::uint64_t sequence = 0;
  int allocations = 0;

  explicit HeldThing(float stiffness) {
    haptics::TickCommands commands;
    commands.armed = 1;
    commands.squeeze_stiffness = stiffness;
    bus.task_to_haptic.publish(commands, 0);
  }
  /// A millisecond with both fingers `depth` deep in the thing.
  void step(double depth) {
    const std::int64_t now = static_cast<std::int64_t>(++sequence) * kMillisecond;
    for (std::size_t t = 0; t < 2; ++t) {
      const double side = t == 0 ? 1 : -1;
      haptics::DeviceReading reading;
      reading.t_ns = now;
      reading.sequence = sequence;
      reading.homed = 1;
      reading.p_DE = {side * (kHalf - depth), 0, 0};
      devices[t].publish(reading, now);
      haptics::WrenchSample sample;
      sample.t_ns = now;
      sample.sequence = sequence;
      sample.f_S = {side * haptics::forceOf(kSides, std::max(depth, 0.0), 0), 0, 0};
      if (!silent[t]) sensors[t].publish(sample, now);
    }
    const NoAllocation guard;
    EXPECT_EQ(haptic.step(now), now + kMillisecond);
    allocations += guard.allocations();
  }
  void squeeze(double to) {
    for (double depth = -1e-3; depth < to; depth += 2e-5) step(depth);
    for (int i = 0; i < 100; ++i) step(to);
  }
  std::vector<haptics::FlightRecord> recorded() {
    std::vector<haptics::FlightRecord> all;
    haptics::FlightRecord record;
    while (bus.haptic_to_recorder.pop(&record)) all.push_back(record);
    return all;
  }
  Vec3 commanded(std::size_t t) {
    return unpack(devices[t].commanded(static_cast<std::int64_t>(sequence) * kMillisecond));
  }
};

TEST(PairLoop, TheTickAfterAnEmergencyStopHasNoForceForEitherHand) {
  HeldThing held(1.5f);
  held.squeeze(0.004);
  ASSERT_GT(held.commanded(0).norm(), 0.05);
  ASSERT_GT(held.commanded(1).norm(), 0.05);
  held.bus.stop.press();
  held.step(0.004);
  EXPECT_EQ(held.commanded(0), Vec3(0, 0, 0));
  EXPECT_EQ(held.commanded(1), Vec3(0, 0, 0));
  EXPECT_EQ(held.allocations, 0);
}

TEST(PairLoop, EveryTickIsRecordedOfBothInTurnAndNothingIsAllocated) {
  HeldThing held(1.5f);
  held.squeeze(0.004);
  const std::vector<haptics::FlightRecord> records = held.recorded();
  ASSERT_EQ(records.size(), 2 * held.sequence);
  for (std::size_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(records[i].tool, i % 2);
    EXPECT_EQ(records[i].tick, records[i - i % 2].tick);
  }
  EXPECT_EQ(held.allocations, 0);
}

TEST(PairLoop, EachDeviceGetsItsOwnForceAndTheSceneBothTips) {
  HeldThing held(1.5f);
  held.squeeze(0.004);
  EXPECT_GT(held.commanded(0).x(), 0.05);
  EXPECT_LT(held.commanded(1).x(), -0.05);
  EXPECT_LT((held.commanded(0) + held.commanded(1)).norm(), 0.02);
  const std::int64_t now = static_cast<std::int64_t>(held.sequence) * kMillisecond;
  const ToolState* first = held.bus.haptic_to_scene.read(now);
  const ToolState* second = held.bus.second_to_scene.read(now);
  ASSERT_TRUE(first && second);
  EXPECT_NEAR(first->X_DT.p[0], kHalf - 0.004, 1e-3);
  EXPECT_NEAR(second->X_DT.p[0], 0.004 - kHalf, 1e-3);
}

TEST(PairLoop, ASensorThatFallsSilentTakesTheForceFromBoth) {
  HeldThing held(1.5f);
  held.squeeze(0.004);
  held.silent[1] = true;
  for (int i = 0; i < 400; ++i) held.step(0.004);
  EXPECT_EQ(held.commanded(0), Vec3::Zero());
  EXPECT_EQ(held.commanded(1), Vec3::Zero());
}

}  // namespace
}  // namespace palpa::runtime

#include "tests/support/allocation_guard.h"

#include <gtest/gtest.h>

#include "fake_net_ft.h"
#include "haptics/sensors/force_sensor.h"
#include "haptics/sensors/net_ft_sensor.h"
#include "haptics/sensors/reaction_filter.h"
#include "haptics/sensors/wrench_filter.h"
#include "moving_tool.h"

namespace palpa::haptics {
namespace {

TEST(Allocation, TheGuardSeesOne) {
  const NoAllocation guard;
  const std::vector<int> one(100);
  EXPECT_EQ(guard.allocations(), 1) << one.size();
}

TEST(Allocation, SensorsStepAndReadWithoutAny) {
  FakeNetFt server;
  NetFtSettings settings;
  settings.address = "127.0.0.1";
  settings.port = server.port();
  settings.wait_ms = 5000;
  std::int64_t now = 0;
  NetFtSensor sensor(settings, [&] { return now; });
  sensor.start();
  for (std::uint32_t i = 2; i < 50; ++i) server.send(recordBytes(i, 100 + i, i % 2));
  server.send(recordBytes(2, 102));
  server.send({1});
  ReplaySensor replay({}, std::vector<WrenchSample>(3));
  sensor.requestBias();
  const NoAllocation guard;
  for (std::uint32_t i = 1; i < 50; ++i) {
    sensor.step();
    sensor.read(now);
    replay.read(now);
  }
  now = 10'000'000'000;
  sensor.step();
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_EQ(sensor.count(NetFtCount::records), 49u);
  EXPECT_EQ(sensor.count(NetFtCount::late), 1u);
  EXPECT_EQ(sensor.count(NetFtCount::wrong_length), 1u);
  EXPECT_EQ(sensor.count(NetFtCount::restarts), 1u);
}

TEST(Allocation, TheFilterStepsWithoutAny) {
  const MovingTool tool(2);
  WrenchFilter filter;
  filter.low_pass = butterworth(30, 1000);
  filter.tool = tool.load();
  WrenchFilterState state;
  bool valid = true;
  const NoAllocation guard;
  for (int k = 0; k < 100; ++k)
    valid = step(filter, state, {}, tool.pose(k * 1e-3), k * 1'000'000LL).valid;
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_TRUE(valid);
}

TEST(Allocation, TheKalmanFilterStepsWithoutAny) {
  const MovingTool tool(2);
  ReactionSettings settings;
  settings.tool = tool.load();
  const ReactionFilter filter(settings);
  ReactionState state;
  bool valid = true;
  const NoAllocation guard;
  for (int k = 0; k < 1000; ++k)
    valid = step(filter, state, {}, tool.pose(k * 1e-3), k * 1'000'000LL).valid;
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_TRUE(valid);
}

}  // namespace
}  // namespace palpa::haptics

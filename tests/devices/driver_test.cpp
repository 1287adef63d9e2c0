#include "haptics/devices/falcon/falcon_driver.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "scripted_station.h"
#include "tests/support/allocation_guard.h"

namespace palpa::haptics {
namespace {

using test::ReadyStation;
using test::Station;

TEST(FalconDriver, UploadsItsImageThenHomesThenIsReady) {
  Station s;
  s.rig.step();
  EXPECT_EQ(s.rig.state(), DriverState::preparing);
  ASSERT_TRUE(s.rig.reach(DriverState::homing));
  EXPECT_EQ(s.twin.image, test::someImage());
  EXPECT_EQ(s.twin.chunks, (8492 + 61) / 62);
  EXPECT_EQ(s.twin.largest_chunk, 62u);
  EXPECT_EQ(s.twin.latency_ms, 1);
  ASSERT_TRUE(s.rig.reach(DriverState::ready));
  EXPECT_EQ(s.rig.driver.details().uploads, 1u);
  EXPECT_EQ(s.rig.driver.details().problem, FalconProblem::none);
}

TEST(FalconDriver, AZeroBeforeTheGreetingIsPassedOver) {
  Station s;
  s.twin.zero_before_greeting = true;
  EXPECT_TRUE(s.rig.reach(DriverState::homing));
  EXPECT_EQ(s.twin.resets, 1);
}

TEST(FalconDriver, AWrongEchoStartsTheUploadAnew) {
  for (const int chunk : {0, 70, 136}) {
    Station s;
    s.twin.corrupt_chunk = chunk;
    s.rig.step();
    s.rig.step();
    EXPECT_EQ(s.rig.driver.details().problem, FalconProblem::upload_failed);
    EXPECT_EQ(s.rig.state(), DriverState::opening);
    EXPECT_EQ(s.twin.chunks, chunk + 1) << "nothing is sent after it";
    ASSERT_TRUE(s.rig.reach(DriverState::ready)) << chunk;
    EXPECT_EQ(s.twin.resets, 2);
    EXPECT_EQ(s.twin.image, test::someImage());
    EXPECT_EQ(s.rig.driver.details().problem, FalconProblem::none);
  }
}

TEST(FalconDriver, RunningFirmwareIsLeftAlone) {
  Station s(test::Bytes{});
  s.twin.startFirmware();
  EXPECT_TRUE(s.rig.reach(DriverState::ready));
  EXPECT_EQ(s.twin.resets, 0);
}

TEST(FalconDriver, WithoutFirmwareItSaysSo) {
  Station s(test::Bytes{});
  s.rig.step();
  EXPECT_EQ(s.rig.driver.details().problem, FalconProblem::needs_firmware);
  EXPECT_EQ(s.rig.state(), DriverState::opening);
}

TEST(FalconDriver, NoForceAndRedLightUntilHomed) {
  Station s;
  s.rig.f_D = {3, -2, 4};
  ASSERT_TRUE(s.rig.reach(DriverState::homing));
  while (s.rig.state() == DriverState::homing) {
    EXPECT_EQ(s.rig.driver.read(s.rig.now_ns).homed, 0u);
    s.rig.step();
  }
  EXPECT_GE(s.twin.commands.size(), 30u);
  for (const test::TwinCommand& command : s.twin.commands) {
    EXPECT_FALSE(command.pushes());
    EXPECT_EQ(command.flags, kFalconHoming | kFalconRed);
  }
  s.rig.step();
  EXPECT_EQ(s.rig.lastCommand().flags, kFalconGreen);
  s.rig.step();
  EXPECT_TRUE(s.rig.lastCommand().pushes());
  EXPECT_EQ(s.rig.driver.read(s.rig.now_ns).homed, 1u);
}

TEST(FalconDriver, FiveThousandCyclesEveryByteInPlace) {
  Station s;
  test::cycleAndCheck(s.rig, 5000);
  EXPECT_EQ(s.rig.driver.details().missed, 0u);
  EXPECT_EQ(s.rig.driver.details().skipped_bytes, 0u);
}

TEST(FalconDriver, TheLastPacketIsZero) {
  ReadyStation s;
  const std::size_t before = s.rig.heard();
  s.rig.driver.close();
  EXPECT_EQ(s.rig.heard(), before + 1);
  EXPECT_FALSE(s.rig.lastCommand().pushes());
  EXPECT_EQ(s.rig.lastCommand().flags, 0);
  EXPECT_EQ(s.usb.closed, 1);
  EXPECT_EQ(s.rig.driver.read(0).homed, 0u);
  EXPECT_EQ(s.rig.driver.step(s.rig.now_ns + 1), FalconLink::kNever);
  EXPECT_EQ(s.rig.heard(), before + 1) << "nothing after it";
}

TEST(FalconDriver, TheLastPacketIsZeroAlsoWhenItIsDestroyed) {
  test::FalconTwin twin(test::someImage());
  twin.startFirmware();
  {
    test::FalconRig rig(std::make_unique<test::ScriptedUsb>(twin), twin, {});
    rig.f_D = {0, 1, 0};
    ASSERT_TRUE(rig.reach(DriverState::ready));
    for (int i = 0; i < 3; ++i) rig.step();
    ASSERT_TRUE(rig.lastCommand().pushes());
  }
  EXPECT_FALSE(twin.commands.back().pushes());
}

TEST(FalconDriver, LoopAndDeviceThreadExchangeWholeValues) {
  ReadyStation s;
  std::atomic<bool> done{false};
  std::atomic<std::int64_t> now_ns{s.rig.now_ns};
  std::thread device([&] {
    for (int i = 0; i < 3000; ++i) {
      // On the axis the height tells the three encoders' count: a torn position would leave the
      // axis.
      s.twin.reply.encoder.fill(static_cast<std::int16_t>(i % 500));
      s.rig.driver.step(now_ns += 1'000'000);
    }
    done = true;
  });
  std::uint64_t last = 0, back = 0, torn = 0, seen = 0;
  while (!done) {
    const std::int64_t t_ns = now_ns;
    s.rig.driver.command(t_ns, {0, 0, 1});
    const DeviceReading reading = s.rig.driver.read(t_ns);
    seen += reading.sequence > last;
    back += reading.sequence < last;
    torn += std::abs(reading.p_DE[0]) > 1e-6 || std::abs(reading.p_DE[1]) > 1e-6;
    last = reading.sequence;
  }
  device.join();
  EXPECT_EQ(back, 0u);
  EXPECT_EQ(torn, 0u);
  EXPECT_GT(seen, 0u);
  EXPECT_EQ(s.rig.driver.details().missed, 0u);
}

TEST(FalconDriver, ReadAndCommandNeverAllocate) {
  ReadyStation s;
  double sum = 0;
  for (int i = 0; i < 1000; ++i) {
    int allocations = 0;
    {
      const NoAllocation guard;
      s.rig.driver.command(s.rig.now_ns, {0, 0, 1e-3 * i});
      sum += s.rig.driver.read(s.rig.now_ns).p_DE[2];
      allocations = guard.allocations();
    }
    ASSERT_EQ(allocations, 0);
    s.rig.step();
  }
  EXPECT_GT(sum, 0);
}

}  // namespace
}  // namespace palpa::haptics

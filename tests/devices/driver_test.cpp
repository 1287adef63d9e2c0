#include "haptics/devices/falcon_driver.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <new>

#include "falcon_rig.h"
#include "scripted_usb.h"

namespace {
thread_local bool allocation_forbidden = false;
thread_local int allocations = 0;
}  // namespace

// Not inlined: the compiler would otherwise pair our free() with its own idea of new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (allocation_forbidden) ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace palpa::haptics {
namespace {

/// Driver on a scripted cable.
struct Station {
  explicit Station(test::Bytes firmware = test::someImage())
      : twin(test::someImage()), owned(std::make_unique<test::ScriptedUsb>(twin)), usb(*owned),
        rig(std::move(owned), twin, std::move(firmware)) {}
  test::FalconTwin twin;
  std::unique_ptr<test::ScriptedUsb> owned;
  test::ScriptedUsb& usb;
  test::FalconRig rig;
};

/// The same with the device ready and a force on the way.
struct ReadyStation : Station {
  ReadyStation() {
    twin.startFirmware();
    EXPECT_TRUE(rig.reach(FalconState::ready));
    rig.f_D = {0, 0, 2};
    rig.step();
    rig.step();
    EXPECT_TRUE(rig.lastCommand().pushes());
  }
};

TEST(FalconDriver, UploadsItsImageThenHomesThenIsReady) {
  Station s;
  s.rig.step();
  EXPECT_EQ(s.rig.state(), FalconState::uploading);
  ASSERT_TRUE(s.rig.reach(FalconState::homing));
  EXPECT_EQ(s.twin.image, test::someImage());
  EXPECT_EQ(s.twin.chunks, (8492 + 61) / 62);
  EXPECT_EQ(s.twin.largest_chunk, 62u);
  EXPECT_EQ(s.twin.latency_ms, 1);
  ASSERT_TRUE(s.rig.reach(FalconState::ready));
  EXPECT_EQ(s.rig.driver.status().uploads, 1u);
  EXPECT_EQ(s.rig.driver.status().problem, FalconProblem::none);
}

TEST(FalconDriver, AZeroBeforeTheGreetingIsPassedOver) {
  Station s;
  s.twin.zero_before_greeting = true;
  EXPECT_TRUE(s.rig.reach(FalconState::homing));
  EXPECT_EQ(s.twin.resets, 1);
}

TEST(FalconDriver, AWrongEchoStartsTheUploadAnew) {
  for (const int chunk : {0, 70, 136}) {
    Station s;
    s.twin.corrupt_chunk = chunk;
    s.rig.step();
    s.rig.step();
    EXPECT_EQ(s.rig.driver.status().problem, FalconProblem::upload_failed);
    EXPECT_EQ(s.rig.state(), FalconState::opening);
    ASSERT_TRUE(s.rig.reach(FalconState::ready)) << chunk;
    EXPECT_EQ(s.twin.resets, 2);
    EXPECT_EQ(s.twin.image, test::someImage());
    EXPECT_EQ(s.rig.driver.status().problem, FalconProblem::none);
  }
}

TEST(FalconDriver, RunningFirmwareIsLeftAlone) {
  Station s(test::Bytes{});
  s.twin.startFirmware();
  EXPECT_TRUE(s.rig.reach(FalconState::ready));
  EXPECT_EQ(s.twin.resets, 0);
}

TEST(FalconDriver, WithoutFirmwareItSaysSo) {
  Station s(test::Bytes{});
  s.rig.step();
  EXPECT_EQ(s.rig.driver.status().problem, FalconProblem::needs_firmware);
  EXPECT_EQ(s.rig.state(), FalconState::opening);
}

TEST(FalconDriver, NoForceAndRedLightUntilHomed) {
  Station s;
  s.rig.f_D = {3, -2, 4};
  ASSERT_TRUE(s.rig.reach(FalconState::homing));
  while (s.rig.state() == FalconState::homing) {
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
  EXPECT_EQ(s.rig.driver.status().missed, 0u);
  EXPECT_EQ(s.rig.driver.status().skipped_bytes, 0u);
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
    ASSERT_TRUE(rig.reach(FalconState::ready));
    for (int i = 0; i < 3; ++i) rig.step();
    ASSERT_TRUE(rig.lastCommand().pushes());
  }
  EXPECT_FALSE(twin.commands.back().pushes());
}

TEST(FalconDriver, AStallOrATimeOutCostsOnePacketAndForceComesBack) {
  for (const UsbStatus fault : {UsbStatus::stall, UsbStatus::timeout, UsbStatus::other}) {
    ReadyStation s;
    const std::uint64_t sequence = s.rig.driver.read(0).sequence;
    s.usb.in_faults = {fault};
    s.rig.step();
    EXPECT_EQ(s.rig.driver.read(0).sequence, sequence) << "nothing heard, nothing counted";
    s.rig.step();
    EXPECT_FALSE(s.rig.lastCommand().pushes()) << "no force on a position not known";
    EXPECT_EQ(s.rig.driver.read(0).sequence, sequence + 1);
    s.rig.step();
    EXPECT_TRUE(s.rig.lastCommand().pushes());
    const FalconStatus status = s.rig.driver.status();
    EXPECT_EQ(status.missed, 1u);
    EXPECT_EQ(status.stalls, fault == UsbStatus::stall ? 1u : 0u);
    EXPECT_EQ(status.timeouts, fault == UsbStatus::timeout ? 1u : 0u);
    EXPECT_EQ(status.state, FalconState::ready);
  }
}

TEST(FalconDriver, ALateAnswerIsNotTakenForTheNext) {
  ReadyStation s;
  s.rig.holdGripAt({0, 0, 0.10});
  s.usb.in_faults = {UsbStatus::timeout};
  s.rig.step();  // the answer stays in the chip
  s.rig.holdGripAt({0, 0, 0.14});
  s.rig.step();
  EXPECT_NEAR(s.rig.driver.read(0).p_DE[2], 0.14, 1e-4);
}

TEST(FalconDriver, ASilentDeviceIsOpenedAgain) {
  ReadyStation s;
  s.twin.mute = true;
  for (int i = 0; i < 49; ++i) s.rig.step();
  EXPECT_EQ(s.rig.state(), FalconState::ready);
  s.rig.step();
  EXPECT_EQ(s.rig.state(), FalconState::lost);
  EXPECT_EQ(s.rig.driver.status().problem, FalconProblem::silent);
  EXPECT_EQ(s.rig.driver.read(0).homed, 0u);
  s.twin.mute = false;
  EXPECT_TRUE(s.rig.reach(FalconState::ready));
}

TEST(FalconDriver, UnpluggedAndPluggedInAgainItGoesOn) {
  for (const bool power_lost : {false, true}) {
    ReadyStation s;
    test::cycleAndCheck(s.rig, 200);
    s.usb.unplug();
    s.rig.step();
    EXPECT_EQ(s.rig.state(), FalconState::lost);
    EXPECT_EQ(s.rig.driver.status().problem, FalconProblem::absent);
    EXPECT_EQ(s.rig.driver.read(0).homed, 0u);
    for (int i = 0; i < 5; ++i) s.rig.step();
    if (power_lost) s.twin.powerOff();
    s.usb.plugged = true;
    const std::size_t before = s.rig.heard();
    ASSERT_TRUE(s.rig.reach(FalconState::homing));
    for (std::size_t i = before; i < s.twin.commands.size(); ++i)
      EXPECT_FALSE(s.twin.commands[i].pushes()) << "it may have been moved meanwhile";
    test::cycleAndCheck(s.rig, 200);
    EXPECT_EQ(s.rig.driver.status().uploads, power_lost ? 1u : 0u);
  }
}

TEST(FalconDriver, ItLooksEverMoreSeldomForADeviceThatIsNotThere) {
  Station s;
  s.usb.plugged = false;
  std::vector<std::int64_t> pauses_ms;
  for (int i = 0; i < 8; ++i) {
    s.rig.step();
    pauses_ms.push_back((s.rig.due_ns - s.rig.now_ns) / 1'000'000);
  }
  EXPECT_EQ(pauses_ms, (std::vector<std::int64_t>{50, 100, 200, 400, 800, 1600, 2000, 2000}));
  EXPECT_EQ(s.rig.driver.step(s.rig.now_ns + 1), s.rig.due_ns) << "not due: nothing happens";
  s.usb.plugged = true;
  EXPECT_TRUE(s.rig.reach(FalconState::ready));
}

TEST(FalconDriver, LostHomingTakesTheForceAway) {
  ReadyStation s;
  s.twin.loseHoming();
  s.rig.step();
  EXPECT_EQ(s.rig.state(), FalconState::homing);
  s.rig.step();
  EXPECT_FALSE(s.rig.lastCommand().pushes());
  EXPECT_EQ(s.rig.lastCommand().flags, kFalconHoming | kFalconRed);
}

TEST(FalconDriver, AnOldCommandIsNotRendered) {
  ReadyStation s;
  const std::int64_t last = s.rig.now_ns;  // the loop stops here
  s.rig.driver.step(last + 20'000'000);
  EXPECT_TRUE(s.rig.lastCommand().pushes());
  s.rig.driver.step(last + 21'000'001);
  EXPECT_FALSE(s.rig.lastCommand().pushes());
}

TEST(FalconDriver, AForceThatIsNoNumberIsNone) {
  ReadyStation s;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    s.rig.f_D = {0, bad, 1};
    s.rig.step();
    EXPECT_FALSE(s.rig.lastCommand().pushes());
  }
}

TEST(FalconDriver, AnglesThatNoPositionHasTakeTheForceAwayUntilTheyFit) {
  ReadyStation s;
  const std::uint64_t sequence = s.rig.driver.read(0).sequence;
  s.twin.reply.encoder = {30'000, -30'000, 0};
  s.rig.step();
  EXPECT_EQ(s.rig.driver.read(0).sequence, sequence);
  EXPECT_EQ(s.rig.driver.read(0).homed, 0u);
  s.rig.step();
  EXPECT_FALSE(s.rig.lastCommand().pushes());
  s.rig.holdGripAt({0.01, 0.02, 0.11});
  s.rig.step();
  s.rig.step();
  EXPECT_TRUE(s.rig.lastCommand().pushes());
  EXPECT_NEAR(s.rig.driver.read(0).p_DE[1], 0.02, 1e-4);
}

TEST(FalconDriver, ReadAndCommandNeverAllocate) {
  ReadyStation s;
  double sum = 0;
  for (int i = 0; i < 1000; ++i) {
    allocations = 0;
    allocation_forbidden = true;
    s.rig.driver.command(s.rig.now_ns, {0, 0, 1e-3 * i});
    sum += s.rig.driver.read(s.rig.now_ns).p_DE[2];
    allocation_forbidden = false;
    ASSERT_EQ(allocations, 0);
    s.rig.step();
  }
  EXPECT_GT(sum, 0);
}

}  // namespace
}  // namespace palpa::haptics

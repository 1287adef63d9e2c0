#include <gtest/gtest.h>

#include <limits>

#include "haptics/devices/falcon/falcon_driver.h"
#include "scripted_station.h"

namespace palpa::haptics {
namespace {

using test::ReadyStation;
using test::Station;

TEST(FalconFaults, AStallOrATimeOutCostsOnePacketAndForceComesBack) {
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
    const FalconStatus status = s.rig.driver.details();
    EXPECT_EQ(status.missed, 1u);
    EXPECT_EQ(status.stalls, fault == UsbStatus::stall ? 1u : 0u);
    EXPECT_EQ(status.timeouts, fault == UsbStatus::timeout ? 1u : 0u);
    EXPECT_EQ(status.state, DriverState::ready);
  }
}

TEST(FalconFaults, ALateAnswerIsNotTakenForTheNext) {
  ReadyStation s;
  s.rig.holdGripAt({0, 0, 0.10});
  s.usb.in_faults = {UsbStatus::timeout};
  s.rig.step();  // the answer stays in the chip
  s.rig.holdGripAt({0, 0, 0.14});
  s.rig.step();
  EXPECT_NEAR(s.rig.driver.read(0).p_DE[2], 0.14, 1e-4);
}

TEST(FalconFaults, ASilentDeviceIsOpenedAgain) {
  ReadyStation s;
  s.twin.mute = true;
  for (int i = 0; i < 49; ++i) s.rig.step();
  EXPECT_EQ(s.rig.state(), DriverState::ready);
  s.rig.step();
  EXPECT_EQ(s.rig.state(), DriverState::lost);
  EXPECT_EQ(s.rig.driver.details().problem, FalconProblem::silent);
  EXPECT_EQ(s.rig.driver.read(0).homed, 0u);
  s.twin.mute = false;
  EXPECT_TRUE(s.rig.reach(DriverState::ready));
}

TEST(FalconFaults, UnpluggedAndPluggedInAgainItGoesOn) {
  for (const bool power_lost : {false, true}) {
    ReadyStation s;
    test::cycleAndCheck(s.rig, 200);
    s.usb.unplug();
    s.rig.step();
    EXPECT_EQ(s.rig.state(), DriverState::lost);
    EXPECT_EQ(s.rig.driver.details().problem, FalconProblem::absent);
    EXPECT_EQ(s.rig.driver.read(0).homed, 0u);
    for (int i = 0; i < 5; ++i) s.rig.step();
    if (power_lost) s.twin.powerOff();
    s.usb.plugged = true;
    const std::size_t before = s.rig.heard();
    ASSERT_TRUE(s.rig.reach(DriverState::homing));
    for (std::size_t i = before; i < s.twin.commands.size(); ++i)
      EXPECT_FALSE(s.twin.commands[i].pushes()) << "it may have been moved meanwhile";
    test::cycleAndCheck(s.rig, 200);
    EXPECT_EQ(s.rig.driver.details().uploads, power_lost ? 1u : 0u);
  }
}

TEST(FalconFaults, ItLooksEverMoreSeldomForADeviceThatIsNotThere) {
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
  EXPECT_TRUE(s.rig.reach(DriverState::ready));
}

TEST(FalconFaults, LostHomingTakesTheForceAway) {
  ReadyStation s;
  s.twin.loseHoming();
  s.rig.step();
  EXPECT_EQ(s.rig.state(), DriverState::homing);
  s.rig.step();
  EXPECT_FALSE(s.rig.lastCommand().pushes());
  EXPECT_EQ(s.rig.lastCommand().flags, kFalconHoming | kFalconRed);
}

TEST(FalconFaults, AnOldCommandIsNotRendered) {
  ReadyStation s;
  const std::int64_t last = s.rig.now_ns;  // the loop stops here
  s.rig.driver.step(last + 10'000'000);
  EXPECT_TRUE(s.rig.lastCommand().pushes());
  s.rig.driver.step(last + 11'000'001);
  EXPECT_FALSE(s.rig.lastCommand().pushes());
}

TEST(FalconFaults, AForceThatIsNoNumberIsNone) {
  ReadyStation s;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    s.rig.f_D = {0, bad, 1};
    s.rig.step();
    EXPECT_FALSE(s.rig.lastCommand().pushes());
  }
}

TEST(FalconFaults, AnglesThatNoPositionHasTakeTheForceAwayUntilTheyFit) {
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

}  // namespace
}  // namespace palpa::haptics

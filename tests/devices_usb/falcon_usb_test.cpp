#include <gtest/gtest.h>

#include "emulated_usb.h"
#include "haptics/devices/usb_transport.h"
#include "tests/devices/falcon_rig.h"

/// The driver, unchanged, on the real libusb and an emulated kernel: requests, states and faults.
/// How long anything takes says nothing here.
namespace palpa::haptics {
namespace {

/// A busy machine must not look like a silent device: every time-out twenty times as long.
class PatientUsb final : public UsbTransport {
 public:
  UsbStatus open() noexcept override { return usb_.open(); }
  void close() noexcept override { usb_.close(); }
  UsbStatus control(const UsbControl& request, unsigned timeout_ms) noexcept override {
    return usb_.control(request, 20 * timeout_ms);
  }
  UsbStatus bulkOut(std::span<const std::uint8_t> bytes, unsigned timeout_ms) noexcept override {
    return usb_.bulkOut(bytes, 20 * timeout_ms);
  }
  UsbStatus bulkIn(std::span<std::uint8_t> into, std::size_t& got,
                   unsigned timeout_ms) noexcept override {
    return usb_.bulkIn(into, got, 20 * timeout_ms);
  }

 private:
  LibusbTransport usb_{kFalconUsb};
};

class FalconOnUsb : public testing::Test {
 protected:
  void SetUp() override {
    if (*test::EmulatedUsb::missing()) GTEST_SKIP() << test::EmulatedUsb::missing();
    usb = std::make_unique<test::EmulatedUsb>(twin);
    ASSERT_TRUE(umockdev_in_mock_environment());
    rig =
        std::make_unique<test::FalconRig>(std::make_unique<PatientUsb>(), twin, test::someImage());
  }
  void TearDown() override {
    rig.reset();
    usb.reset();
  }
  void start() {
    twin.startFirmware();
    ASSERT_TRUE(rig->reach(DriverState::ready));
    rig->f_D = {0, 0, 2};
    for (int i = 0; i < 3; ++i) rig->step();
    ASSERT_TRUE(rig->lastCommand().pushes());
  }
  test::FalconTwin twin{test::someImage()};
  std::unique_ptr<test::EmulatedUsb> usb;
  std::unique_ptr<test::FalconRig> rig;
};

TEST_F(FalconOnUsb, UploadsHomesAndRunsFiveThousandCycles) {
  twin.corrupt_chunk = 40;
  ASSERT_TRUE(rig->reach(DriverState::homing));
  EXPECT_EQ(twin.image, test::someImage());
  EXPECT_EQ(twin.resets, 2) << "once more after the wrong echo";
  EXPECT_EQ(rig->driver.details().uploads, 1u);
  ASSERT_TRUE(rig->reach(DriverState::ready));
  for (const test::TwinCommand& command : twin.commands) EXPECT_FALSE(command.pushes());
  test::cycleAndCheck(*rig, 5000);
  EXPECT_EQ(rig->driver.details().missed, 0u);
}

TEST_F(FalconOnUsb, TheLastPacketIsZeroAndTheKernelsDriverComesBack) {
  start();
  EXPECT_FALSE(usb->kernel_driver);
  rig->driver.close();
  EXPECT_FALSE(rig->lastCommand().pushes());
  EXPECT_EQ(rig->lastCommand().flags, 0);
  EXPECT_EQ(usb->claims, 1);
  EXPECT_EQ(usb->releases, 1);
  EXPECT_TRUE(usb->kernel_driver);
}

TEST_F(FalconOnUsb, AStallIsClearedAndCostsOnePacket) {
  start();
  usb->stalls = 1;
  rig->step();
  EXPECT_EQ(usb->cleared_halts, 1);
  EXPECT_EQ(rig->driver.details().stalls, 1u);
  test::cycleAndCheck(*rig, 100);
  EXPECT_EQ(rig->driver.details().missed, 1u);
}

TEST_F(FalconOnUsb, ATimeOutCostsOnePacket) {
  start();
  usb->silences = 1;
  rig->step();
  EXPECT_EQ(rig->driver.details().timeouts, 1u);
  rig->step();
  EXPECT_FALSE(rig->lastCommand().pushes());
  test::cycleAndCheck(*rig, 100);
  EXPECT_EQ(rig->driver.details().missed, 1u);
}

TEST_F(FalconOnUsb, UnpluggedAndPluggedInAgainItGoesOn) {
  start();
  usb->unplug();
  for (int i = 0; i < 4; ++i) rig->step();
  EXPECT_EQ(rig->state(), DriverState::lost);
  EXPECT_EQ(rig->driver.details().problem, FalconProblem::absent);
  EXPECT_EQ(rig->driver.read(0).homed, 0u);
  twin.powerOff();
  usb->plugIn();
  ASSERT_TRUE(rig->reach(DriverState::ready));
  EXPECT_EQ(rig->driver.details().uploads, 1u);
  test::cycleAndCheck(*rig, 500);
}

TEST_F(FalconOnUsb, TwoAtOnceAreTwo) {
  test::FalconTwin other_twin{test::someImage()};
  test::EmulatedUsb other_usb(other_twin, 2);
  test::FalconRig other(std::make_unique<PatientUsb>(), other_twin, test::someImage());
  // Whichever device it gets, it is closed before that is taken away.
  const std::unique_ptr<test::FalconRig> one = std::move(rig);
  twin.startFirmware();
  other_twin.startFirmware();
  for (int i = 0;
       i < 200 && (one->state() != DriverState::ready || other.state() != DriverState::ready);
       ++i) {
    one->step();
    other.step();
  }
  ASSERT_EQ(one->state(), DriverState::ready);
  ASSERT_EQ(other.state(), DriverState::ready);
  // Whichever driver has got which device: grips apart, forces against each other, nothing mixed
  // up.
  const bool crossed = other_usb.claims == 1 && usb->claims == 1 && [&] {
    other.holdGripAt(kFalconCentre + Vec3(0.02, 0, 0));
    one->holdGripAt(kFalconCentre - Vec3(0.02, 0, 0));
    one->step();
    return unpack(one->driver.read(one->now_ns).p_DE).x() > 0;
  }();
  one->f_D = {2, 0, 0};
  other.f_D = {-2, 0, 0};
  for (int i = 0; i < 50; ++i) {
    one->step();
    other.step();
  }
  test::FalconTwin& of_rig = crossed ? other_twin : twin;
  test::FalconTwin& of_other = crossed ? twin : other_twin;
  const double side = crossed ? -1 : 1;
  EXPECT_NEAR(unpack(one->driver.read(one->now_ns).p_DE).x(), -0.02 * side, 1e-4);
  EXPECT_NEAR(unpack(other.driver.read(other.now_ns).p_DE).x(), 0.02 * side, 1e-4);
  ASSERT_TRUE(of_rig.commands.back().pushes());
  ASSERT_TRUE(of_other.commands.back().pushes());
  const Vec3 here = kFalconCentre - Vec3(0.02 * side, 0, 0),
             there = kFalconCentre + Vec3(0.02 * side, 0, 0);
  EXPECT_LT(test::forceError(of_rig.commands.back(), here, {2, 0, 0}), 1.001);
  EXPECT_LT(test::forceError(of_other.commands.back(), there, {-2, 0, 0}), 1.001);
  EXPECT_EQ(usb->claims + other_usb.claims, 2);
}

TEST_F(FalconOnUsb, AnotherProgramHoldsIt) {
  usb->held = true;
  twin.startFirmware();
  rig->step();
  EXPECT_EQ(rig->driver.details().problem, FalconProblem::busy);
  usb->held = false;
  EXPECT_TRUE(rig->reach(DriverState::ready));
}

TEST_F(FalconOnUsb, NoDevice) {
  usb->unplug();
  rig->step();
  EXPECT_EQ(rig->driver.details().problem, FalconProblem::absent);
  usb->plugIn();
}

}  // namespace
}  // namespace palpa::haptics

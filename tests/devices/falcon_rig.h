#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "anatomy/base/random.h"
#include "falcon_twin.h"
#include "haptics/devices/falcon/falcon_driver.h"

namespace palpa::test {

/// No real image, only bytes of its size.
inline Bytes someImage() {
  RandomStream random(8492, "firmware");
  Bytes image(8492);
  for (auto& byte : image) byte = static_cast<std::uint8_t>(random.bits());
  return image;
}

/// Driver and twin; time passes a millisecond a step, or up to when the driver is due.
struct FalconRig {
  FalconRig(std::unique_ptr<haptics::UsbTransport> usb, FalconTwin& t, Bytes firmware)
      : twin(t), driver(std::move(usb), std::move(firmware)) {
    driver.open();
  }

  FalconTwin& twin;
  haptics::FalconDriver driver;
  std::int64_t now_ns = 0, due_ns = 0;
  Packed3 f_D{0, 0, 0};

  haptics::DriverState state() { return driver.details().state; }
  void step() {
    now_ns = std::max(now_ns + 1'000'000, due_ns);
    driver.command(now_ns, f_D);
    due_ns = driver.step(now_ns);
  }
  /// Steps until `wanted`; false if that takes more than `most`.
  bool reach(haptics::DriverState wanted, int most = 200) {
    for (int i = 0; i < most && state() != wanted; ++i) step();
    return state() == wanted;
  }
  std::size_t heard() {
    const std::scoped_lock lock(twin.mutex);
    return twin.commands.size();
  }
  TwinCommand lastCommand() {
    const std::scoped_lock lock(twin.mutex);
    return twin.commands.empty() ? TwinCommand{} : twin.commands.back();
  }
  void holdGripAt(const Vec3& p) {
    const double count = 2 * std::numbers::pi / 1280 * 14.25 / 110;
    const Vec3 theta = haptics::falconInverse(p)->theta1;
    const std::scoped_lock lock(twin.mutex);
    for (std::size_t leg = 0; leg < 3; ++leg)
      twin.reply.encoder[leg] = static_cast<std::int16_t>(
          std::lround((theta[static_cast<int>(leg)] - 35 * std::numbers::pi / 180) / count));
  }
};

/// How far the force that these counts give at `p` is from `f`, by virtual work on differences of
/// the inverse kinematics; in units of what half a count on every leg makes.
inline double forceError(const TwinCommand& command, const Vec3& p, const Vec3& f) {
  Mat3 J;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 dp = 1e-6 * Vec3::Unit(axis);
    J.col(axis) =
        (haptics::falconInverse(p + dp)->theta1 - haptics::falconInverse(p - dp)->theta1) / 2e-6;
  }
  const Vec3 tau = -1e-4 * Vec3(command.motor[0], command.motor[1], command.motor[2]);
  return (J.transpose() * tau - f).norm() / (0.5e-4 * J.rowwise().norm().sum());
}

/// The grip on a path through the workspace while the loop commands a turning force: in every cycle
/// the position must be right, and every byte of the packet the one that this force needs.
inline void cycleAndCheck(FalconRig& rig, int cycles) {
  ASSERT_TRUE(rig.reach(haptics::DriverState::ready));
  rig.holdGripAt(haptics::kFalconCentre);
  rig.step();
  Vec3 p_before = unpack(rig.driver.read(rig.now_ns).p_DE);
  const double resolution = rig.driver.capabilities().position_resolution;
  for (int i = 0; i < cycles; ++i) {
    const double s = i / 400.0;
    const Vec3 p =
        haptics::kFalconCentre + 0.038 * Vec3(std::sin(3 * s), std::sin(4 * s), std::sin(5 * s));
    rig.holdGripAt(p);
    rig.twin.mutex.lock();
    rig.twin.reply.buttons = static_cast<std::uint8_t>(i & 15);
    rig.twin.cut_reply_at = static_cast<std::size_t>(1 + i % 16);
    rig.twin.mutex.unlock();
    const Vec3 f = 1.5 * Vec3(std::cos(7 * s), std::sin(11 * s), std::cos(13 * s));
    rig.f_D = pack(f);
    const std::uint64_t sequence = rig.driver.read(rig.now_ns).sequence;
    const std::size_t heard = rig.heard();
    rig.step();
    const haptics::DeviceReading reading = rig.driver.read(rig.now_ns);
    ASSERT_EQ(rig.heard(), heard + 1) << i;
    ASSERT_EQ(reading.sequence, sequence + 1) << i;
    ASSERT_EQ(reading.t_ns, rig.now_ns);
    ASSERT_EQ(reading.homed, 1u);
    ASSERT_EQ(reading.buttons, static_cast<std::uint32_t>(i & 15));
    ASSERT_LT((unpack(reading.p_DE) - p).norm(), 2 * resolution) << i;
    // The twin takes a packet only when every byte is in its place.
    const TwinCommand command = rig.lastCommand();
    ASSERT_EQ(command.flags, 2) << "green, nothing else";
    ASSERT_LT(forceError(command, p_before, f), 1.001) << i;
    p_before = unpack(reading.p_DE);
  }
  const std::scoped_lock lock(rig.twin.mutex);
  EXPECT_EQ(rig.twin.malformed, 0);
}

}  // namespace palpa::test

#include <gtest/gtest.h>

#include <cmath>

#include "apps/runtime/button_plunger.h"
#include "apps/runtime/channel_device.h"
#include "apps/runtime/channel_sensor.h"
#include "apps/runtime/force_sensing.h"

namespace palpa::runtime {
namespace {

TEST(ButtonPlunger, DrawsWhileTheButtonIsHeldAndGoesBack) {
  ChannelDevice device({}, TimeMode::virtual_time);
  ButtonPlunger plunger(device, 4);
  const auto press = [&](std::int64_t t_ms, std::uint32_t buttons) {
    haptics::DeviceReading reading;
    reading.buttons = buttons;
    reading.plunger = 0.7;  // no such thing on this device
    device.publish(reading, t_ms * kMillisecond);
    return plunger.read(t_ms * kMillisecond).plunger;
  };
  EXPECT_EQ(press(0, 4), 0);
  EXPECT_NEAR(press(50, 4), 0.05, 1e-12);
  EXPECT_NEAR(press(100, 5), 0.10, 1e-12);
  EXPECT_NEAR(press(150, 1), 0.05, 1e-12) << "another button";
  EXPECT_EQ(press(400, 0), 0);
  for (int t = 500; t < 2500; t += 50) press(t, 4);
  EXPECT_EQ(press(2500, 4), 1);
}

TEST(ButtonPlunger, WithoutAButtonTheDevicesOwnPlungerCounts) {
  ChannelDevice device({}, TimeMode::virtual_time);
  ButtonPlunger plunger(device, 0);
  haptics::DeviceReading reading;
  reading.plunger = 0.7;
  device.publish(reading, 0);
  EXPECT_EQ(plunger.read(0).plunger, 0.7);
}

TEST(ChannelSensor, SaysWhenItIsSilent) {
  ChannelSensor sensor({}, TimeMode::virtual_time);
  EXPECT_EQ(sensor.read(0).flags, haptics::kNothingYet);
  haptics::WrenchSample sample;
  sample.t_ns = 5 * kMillisecond;
  sensor.publish(sample, sample.t_ns);
  EXPECT_EQ(sensor.read(15 * kMillisecond).flags, 0u);
  EXPECT_EQ(sensor.read(15 * kMillisecond + 1).flags, haptics::kSilent);
}

/// A tool turned on its side, touched: gravity and bias are gone, and the touch is told in D.
TEST(ForceSensing, IsTheTouchAloneInTheDevicesFrame) {
  ChannelSensor sensor({}, TimeMode::virtual_time);
  ForceSensing::Setup setup;
  setup.filter.low_pass = haptics::butterworth(100, 1000);
  setup.filter.tool.mass = 0.05;
  setup.filter.bias.f_S = {0.1, 0.2, 0.3};
  setup.X_WD = makePose(Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix(), {1, 0, 0});
  setup.X_ES = makePose(Eigen::AngleAxisd(-0.4, Vec3::UnitY()).toRotationMatrix(), {0, 0, 0.03});
  ForceSensing sensing(sensor, setup);
  haptics::DeviceReading reading;
  reading.homed = 1;
  reading.q_DE = pack(Quat(Eigen::AngleAxisd(0.8, Vec3(3, -1, 1).normalized())));
  const Mat3 R_DS = unpack(reading.q_DE).toRotationMatrix() * setup.X_ES.linear();
  const Vec3 touch_D(0.5, -1, 2), weight_W(0, 0, -0.05 * 9.80665);
  haptics::SensedForce sensed;
  for (std::int64_t i = 0; i < 100; ++i) {
    haptics::WrenchSample sample;
    sample.t_ns = i * kMillisecond;
    sample.sequence = static_cast<std::uint64_t>(i + 1);
    sample.f_S = pack(Vec3(R_DS.transpose() * (touch_D + setup.X_WD.linear().transpose() * weight_W) + Vec3(0.1, 0.2, 0.3)));
    sensor.publish(sample, sample.t_ns);
    reading.t_ns = sample.t_ns;
    sensed = sensing.sense(reading, sample.t_ns);
    if (i == 0) {
      EXPECT_EQ(sensed.state, haptics::SensorState::unusable);
    }
  }
  ASSERT_EQ(sensed.state, haptics::SensorState::valid);
  EXPECT_LT((unpack(sensed.f_D) - touch_D).norm(), 1e-9);
}

/// A device that says nothing for some milliseconds, as under load, takes no force away; a sensor that has a fault does, at once.
TEST(ForceSensing, HoldsThroughAShortGapOfTheDeviceAndNoLonger) {
  struct Sensed {
    ChannelSensor sensor{{}, TimeMode::virtual_time};
    ForceSensing sensing{sensor, [] {
                           ForceSensing::Setup setup;
                           setup.filter.low_pass = haptics::butterworth(100, 1000);
                           return setup;
                         }()};
    std::uint64_t sequence = 0;
    haptics::SensorState at(std::int64_t ms, double force = 1, std::uint32_t flags = 0) {
      haptics::WrenchSample sample;
      sample.t_ns = ms * kMillisecond;
      sample.sequence = ++sequence;
      sample.f_S = {0, 0, force};
      sample.flags = flags;
      sensor.publish(sample, sample.t_ns);
      haptics::DeviceReading reading;
      reading.homed = 1;
      reading.t_ns = sample.t_ns;
      return sensing.sense(reading, sample.t_ns).state;
    }
    void settle() {
      for (std::int64_t ms = 0; ms < 20; ++ms) at(ms);
    }
  };
  using haptics::SensorState;
  Sensed hiccup;
  hiccup.settle();
  for (const std::int64_t ms : {26, 27, 28, 29}) EXPECT_EQ(hiccup.at(ms), SensorState::valid) << ms;
  Sensed away;
  away.settle();
  EXPECT_EQ(away.at(31), SensorState::unusable);
  Sensed broken;
  broken.settle();
  EXPECT_EQ(broken.at(20, 1, haptics::kFault), SensorState::unusable);
  Sensed mad;
  mad.settle();
  EXPECT_EQ(mad.at(20, std::nan("")), SensorState::unusable);
}

}  // namespace
}  // namespace palpa::runtime

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/runtime/clock.h"
#include "apps/runtime/device_adapters.h"
#include "apps/runtime/haptic_activity.h"

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

/// Either filter, of a sensor that knows its bias, on a tool of this mass.
ForceSensingSetup sensingWith(bool kalman, double mass = 0, const Packed3& bias_N = {}) {
  ForceSensingSetup setup;
  haptics::ReactionSettings known;
  known.tool.mass = mass;
  known.bias_N = bias_N;
  if (kalman)
    setup.filter = haptics::ReactionFilter(known);
  else
    setup.filter =
        haptics::WrenchFilter{haptics::butterworth(100, 1000), {}, known.tool, {bias_N, {}}, {}};
  return setup;
}

class ForceSensingBy : public ::testing::TestWithParam<bool> {};
std::string filterName(const ::testing::TestParamInfo<bool>& by) {
  return by.param ? "kalman" : "low_pass";
}
INSTANTIATE_TEST_SUITE_P(Filters, ForceSensingBy, ::testing::Bool(), filterName);

/// A tool turned on its side, touched: gravity and bias are gone, and the touch is told in D.
TEST_P(ForceSensingBy, IsTheTouchAloneInTheDevicesFrame) {
  ChannelSensor sensor({}, TimeMode::virtual_time);
  ForceSensingSetup setup = sensingWith(GetParam(), 0.05, {0.1, 0.2, 0.3});
  setup.X_WD =
      makePose(Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix(), {1, 0, 0});
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
    sample.f_S =
        pack(Vec3(R_DS.transpose() * (touch_D + setup.X_WD.linear().transpose() * weight_W) +
                  Vec3(0.1, 0.2, 0.3)));
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

/// A loop of 4 kHz over a device of 1 kHz: who sets force against depth and takes differences from
/// tick to tick must see no stairs.
TEST_P(ForceSensingBy, APlaceThatMovesEvenlyIsToldEvenlyHoweverOftenItIsAsked) {
  constexpr double kSpeed = 0.02;  // m/s
  ChannelSensor sensor({}, TimeMode::virtual_time);
  ForceSensing sensing(sensor, sensingWith(GetParam()));
  haptics::DeviceReading reading;
  reading.homed = 1;
  double before = 0, least = 1, most = -1;
  for (std::int64_t quarter = 0; quarter < 800; ++quarter) {
    const std::int64_t now = quarter * kMillisecond / 4;
    if (quarter % 4 == 0) {
      reading.t_ns = now;
      reading.p_DE[2] = kSpeed * 1e-9 * static_cast<double>(now);
      haptics::WrenchSample sample;
      sample.t_ns = now;
      sample.sequence = static_cast<std::uint64_t>(quarter + 1);
      sensor.publish(sample, now);
    }
    const haptics::SensedForce sensed = sensing.sense(reading, now);
    const double step = sensed.p_DK[2] - before;
    before = sensed.p_DK[2];
    if (quarter < 400) continue;
    least = std::min(least, step);
    most = std::max(most, step);
  }
  // Where a reading comes, what was predicted is put right, by a part of a step; without looking
  // ahead three steps of four would be nothing.
  const double even = kSpeed * 0.25e-3;
  EXPECT_GT(least, 0.2 * even);
  EXPECT_LT(most, 2.2 * even) << "a stair would be four times as high";
}

/// Ticks of a millisecond: what the sensor measures, the force told, whether the device spoke.
class Gaps : public ::testing::TestWithParam<bool> {
 protected:
  Gaps() {
    for (int i = 0; i < 40; ++i) tick(1);
  }
  haptics::SensedForce tick(double force, bool device_speaks = true, std::uint32_t flags = 0) {
    now_ns_ += kMillisecond;
    haptics::WrenchSample sample;
    sample.t_ns = now_ns_;
    sample.sequence = ++sequence_;
    sample.f_S = {0, 0, force};
    sample.flags = flags;
    sensor_.publish(sample, now_ns_);
    if (device_speaks) reading_.t_ns = now_ns_;
    reading_.homed = 1;
    return sensing_.sense(reading_, now_ns_);
  }
  static bool valid(const haptics::SensedForce& sensed) {
    return sensed.state == haptics::SensorState::valid;
  }

 private:
  ChannelSensor sensor_{{}, TimeMode::virtual_time};
  ForceSensing sensing_{sensor_, sensingWith(GetParam())};
  haptics::DeviceReading reading_;
  std::int64_t now_ns_ = 0;
  std::uint64_t sequence_ = 0;
};

INSTANTIATE_TEST_SUITE_P(Filters, Gaps, ::testing::Bool(), filterName);

/// As under load.
TEST_P(Gaps, AShortOneOfTheDeviceTakesNoForceAway) {
  haptics::SensedForce last;
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(valid(last = tick(1.5, false))) << i;
  for (int i = 0; i < 2; ++i) {
    const haptics::SensedForce after = tick(9);
    ASSERT_TRUE(valid(after)) << i;
    if (GetParam()) continue;  // it has a prediction to go by
    EXPECT_EQ(after.f_D[2], last.f_D[2])
        << "what is told while nobody knows how the tool moves is what was told last";
  }
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(valid(last = tick(2))) << i;
  EXPECT_NEAR(last.f_D[2], 2, 1e-3);
}

TEST_P(Gaps, AFaultOfTheSensorTakesItAwayAtOnceAndNothingOldComesBack) {
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(valid(tick(1, true, haptics::kFault))) << i;
  EXPECT_FALSE(valid(tick(3))) << "the first good sample: nothing is known yet, and what was "
                                  "before the fault is no word for it";
  haptics::SensedForce sensed;
  for (int i = 0; i < 40; ++i) sensed = tick(3);
  ASSERT_TRUE(valid(sensed));
  EXPECT_NEAR(sensed.f_D[2], 3, 1e-3);
  EXPECT_FALSE(valid(tick(std::nan("")))) << "not a number, though nothing is flagged";
  EXPECT_FALSE(valid(tick(3)));
}

TEST_P(ForceSensingBy, AWordIsGoodForTenMillisecondsWhenTheLoopItselfStood) {
  for (const std::int64_t stood_ms : {7, 11}) {
    ChannelSensor sensor({}, TimeMode::virtual_time);
    ForceSensing sensing(sensor, sensingWith(GetParam()));
    haptics::SensedForce sensed;
    haptics::DeviceReading reading;
    reading.homed = 1;
    for (std::int64_t i = 0; i <= 40; ++i) {
      haptics::WrenchSample sample;
      sample.t_ns = reading.t_ns = (i < 40 ? i : 39 + stood_ms) * kMillisecond;
      sample.sequence = static_cast<std::uint64_t>(i + 1);
      sensor.publish(sample, sample.t_ns);
      sensed = sensing.sense(reading, sample.t_ns);
    }
    EXPECT_EQ(sensed.state,
              stood_ms < 10 ? haptics::SensorState::valid : haptics::SensorState::unusable)
        << stood_ms;
  }
}

}  // namespace
}  // namespace palpa::runtime

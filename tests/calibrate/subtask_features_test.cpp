#include "apps/calibrate/subtask_features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

/// Steps of 10 ms from recorded ticks, against figures worked out by hand.
namespace palpa::calibrate {
namespace {

haptics::FlightRecord tickAt(int ms) {
  haptics::FlightRecord record;
  record.tick = ms;
  record.t_ns = std::int64_t{ms} * 1'000'000;
  record.commands.trial = record.commands.armed = 1;
  return record;
}

std::vector<SubtaskSequence> gathered(
    const haptics::TickConfig& config, int ticks,
    const std::function<void(int, haptics::FlightRecord*)>& make) {
  SubtaskSteps steps(config);
  for (int ms = 0; ms < ticks; ++ms) {
    haptics::FlightRecord record = tickAt(ms);
    make(ms, &record);
    steps.add(record);
  }
  return steps.take();
}

TEST(SubtaskFeatures, SpeedIsTheTipsLowPassed) {
  haptics::TickConfig config;
  config.X_ET.p = {0, 0, 0.1};
  // The end effector moves at 20 mm/s along x; the tool does not turn: the tip as well. After n
  // ticks of 1 ms: v (1 - (5/6)^n).
  const auto all = gathered(config, 101, [](int ms, haptics::FlightRecord* r) {
    r->reading.p_DE = {2e-5 * ms, 0, 0};
  });
  ASSERT_EQ(all.size(), 1u);
  ASSERT_EQ(all[0].features.rows(), 10);
  double first = 0;
  for (int n = 0; n < 10; ++n) first += 0.02 * (1 - std::pow(5.0 / 6, n)) / 10;
  EXPECT_NEAR(all[0].features(0, kLogSpeed), std::log(first), 1e-9);
  EXPECT_NEAR(all[0].features(9, kLogSpeed), std::log(0.02), 1e-6);
  // Turned about x by 0.1 mrad a tick: the tip goes 0.1 m x 0.1 rad/s = 10 mm/s.
  const auto turned = gathered(config, 101, [](int ms, haptics::FlightRecord* r) {
    r->reading.q_DE = {std::cos(5e-5 * ms), std::sin(5e-5 * ms), 0, 0};
  });
  EXPECT_NEAR(turned[0].features(9, kLogSpeed), std::log(0.01), 1e-5);
}

TEST(SubtaskFeatures, ForceContactAndShaking) {
  // 1 N up and down by 0.3 N from tick to tick. The low-pass takes 1/9 of what is new: of the
  // alternating part 1/17 with the same sign is left in it, 16/17 shake.
  const auto all = gathered({}, 401, [](int ms, haptics::FlightRecord* r) {
    r->f_contact_D = {0, 0, 1 + (ms % 2 ? -0.3 : 0.3)};
  });
  ASSERT_EQ(all[0].features.rows(), 40);
  const Eigen::RowVectorXd last = all[0].features.row(39);
  EXPECT_NEAR(last[kLogForce], std::log(1), 1e-9);
  EXPECT_NEAR(last[kLogShaking], std::log(0.3 * 16 / 17), 1e-9);
  EXPECT_EQ(last[kInContact], 1);
  EXPECT_EQ(last[kLogSpeed], std::log(kLeastSpeed));
  // Nothing is felt, or too little: figures have a floor. 4 of 10 ticks in contact.
  const auto light = gathered({}, 21, [](int ms, haptics::FlightRecord* r) {
    r->f_contact_D = {0, ms % 10 < 4 ? 0.03 : 0, 0};
  });
  EXPECT_EQ(light[0].features(1, kLogForce), std::log(kLeastForce_N));  // 12 mN in the mean
  EXPECT_NEAR(light[0].features(1, kInContact), 0.4, 1e-12);
  const auto still = gathered({}, 21, [](int, haptics::FlightRecord*) {});
  EXPECT_EQ(still[0].features(1, kLogShaking), std::log(kLeastShaking_N));
  EXPECT_EQ(still[0].features(1, kInContact), 0);
}

TEST(SubtaskFeatures, OfARealThingWhatTheSensorSays) {
  haptics::TickConfig config;
  config.contact_mode = haptics::ContactMode::sensed_object;
  const auto all = gathered(config, 21, [](int ms, haptics::FlightRecord* r) {
    r->sensed.f_D = {3, 0, 4};
    r->sensed.state = ms < 10 ? haptics::SensorState::valid : haptics::SensorState::unusable;
    r->f_contact_D = {0, 0, 2};
  });
  EXPECT_NEAR(all[0].features(0, kLogForce), std::log(5), 1e-12);
  EXPECT_NEAR(all[0].features(1, kLogForce), std::log(2), 1e-12);
}

TEST(SubtaskFeatures, TheLabelIsWhatWasOnForMostOfTheStep) {
  const auto all = gathered({}, 41, [](int ms, haptics::FlightRecord* r) {
    const int step = ms / 10, in = ms % 10;
    r->subtasks = static_cast<std::uint8_t>(step == 0   ? (in < 6 ? 1 : 2)
                                            : step == 1 ? (in < 4 ? 1 : 6)
                                            : step == 2 ? (in % 2 ? 5 : 3)
                                                        : 0);
  });
  EXPECT_EQ(all[0].labels, (std::vector<int>{1, 6, 3, 0}));  // of equals what came first
}

TEST(SubtaskFeatures, GapsBeginANewSequence) {
  const auto all = gathered({}, 300, [](int ms, haptics::FlightRecord* r) {
    if (ms >= 50 && ms < 60) r->commands.armed = 0;
    if (ms >= 110 && ms < 120) r->commands.held = 1;
    if (ms == 200) r->f_contact_D = {0, std::numeric_limits<double>::quiet_NaN(), 0};
    if (ms == 150 || ms == 153) r->tool = 1;  // another device's ticks are not looked at
    if (ms >= 240) r->t_ns += 20'000'000;     // ticks are missing
  });
  ASSERT_EQ(all.size(), 5u);
  const double begins_s[] = {0, 0.06, 0.12, 0.201, 0.26};
  const std::size_t steps[] = {
      4, 4, 7, 3,
      5};  // the last step of a sequence is left out unless a later tick shows that it is full
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(all[i].begins_s, begins_s[i], 1e-9) << i;
    EXPECT_EQ(all[i].labels.size(), steps[i]) << i;
    EXPECT_TRUE(all[i].features.allFinite());
  }
}

}  // namespace
}  // namespace palpa::calibrate

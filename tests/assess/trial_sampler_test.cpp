#include "apps/assess/needle/trial_sampler.h"

#include <gtest/gtest.h>

namespace palpa::assess {
namespace {

haptics::FlightRecord tickAt(std::int64_t ms, std::uint32_t trial = 1, bool armed = true) {
  haptics::FlightRecord record;
  record.t_ns = ms * 1'000'000;
  record.commands.trial = trial;
  record.commands.armed = armed;
  return record;
}

TEST(TrialSampler, PutsTipAndAxisIntoThePatientsFrame) {
  const Mat3 R_AD = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()).toRotationMatrix();
  PackedPose X_ET;
  X_ET.p = {0, 0, 0.1};  // tip 100 mm ahead of the gimbal
  TrialSampler sampler(makePose(R_AD, {1, 2, 3}), X_ET);
  sampler.begin(1);
  haptics::FlightRecord record = tickAt(5);
  record.reading.p_DE = {0.2, 0, 0};
  record.reading.q_DE = pack(Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY())));  // +z to +x
  TrialSample sample;
  ASSERT_TRUE(sampler.add(record, &sample));
  // Tip at x = 0.3 in D; D's x is A's y.
  EXPECT_LT((sample.tip_A - Vec3(1, 2.3, 3)).norm(), 1e-12);
  EXPECT_LT((sample.axis_A - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_EQ(sample.t_s, 0);
}

TEST(TrialSampler, KeepsWhatTheScoreNeeds) {
  TrialSampler sampler(Pose::Identity(), PackedPose{});
  sampler.begin(1);
  haptics::FlightRecord record = tickAt(0);
  record.phase = haptics::NeedlePhase::inserted;
  record.tissue = Tissue::vein_lumen;
  record.wall = Organ::vein;
  record.wall_leaving = 1;
  record.bone = Organ::clavicle;
  record.bone_force = 2;
  record.f_contact_D = {3, 0, 4};
  record.reading.plunger = 0.4;
  TrialSample sample;
  ASSERT_TRUE(sampler.add(record, &sample));
  EXPECT_EQ(sample.phase, haptics::NeedlePhase::inserted);
  EXPECT_EQ(sample.tissue, Tissue::vein_lumen);
  EXPECT_EQ(sample.wall, Organ::vein);
  EXPECT_TRUE(sample.wall_leaving);
  EXPECT_EQ(sample.bone, Organ::clavicle);
  EXPECT_EQ(sample.bone_force, 2);
  EXPECT_DOUBLE_EQ(sample.f_contact, 5);
  EXPECT_EQ(sample.plunger, 0.4);
}

TEST(TrialSampler, PausesStopTheClockAndLoseNoEvent) {
  TrialSampler sampler(Pose::Identity(), PackedPose{});
  sampler.begin(1);
  TrialSample sample;
  ASSERT_TRUE(sampler.add(tickAt(0), &sample));
  ASSERT_TRUE(sampler.add(tickAt(10), &sample));
  haptics::FlightRecord paused = tickAt(20, 1, false);
  paused.events = haptics::kWithdrawn;
  EXPECT_FALSE(sampler.add(paused, &sample));
  ASSERT_TRUE(sampler.add(tickAt(500), &sample));
  EXPECT_DOUBLE_EQ(sample.t_s, 0.010);
  EXPECT_EQ(sample.events, haptics::kWithdrawn);
  ASSERT_TRUE(sampler.add(tickAt(501), &sample));
  EXPECT_DOUBLE_EQ(sample.t_s, 0.011);
  EXPECT_EQ(sample.events, 0u);
}

TEST(TrialSampler, IgnoresOtherTrials) {
  TrialSampler sampler(Pose::Identity(), PackedPose{});
  sampler.begin(2);
  TrialSample sample;
  EXPECT_FALSE(sampler.add(tickAt(0, 1), &sample));
  EXPECT_TRUE(sampler.add(tickAt(0, 2), &sample));
}

}  // namespace
}  // namespace palpa::assess

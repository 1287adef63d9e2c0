#include "apps/task_needle/needle_scene.h"

#include <gtest/gtest.h>

#include "tests/support/simple_patient.h"

namespace palpa::task_needle {
namespace {

constexpr std::int64_t kFrame = 33'333'333;

/// A flat skin in y = 0, outside is -y; the device's frame is turned and moved against A.
class Follower : public testing::Test {
 protected:
  Follower() : patient_(flat()), query_(patient_), follower_(query_, 0) {}

  static anatomy::Patient flat() {
    anatomy::Patient patient;
    test::add(patient, "skin", Organ::skin, test::sheet(0.1, [](double, double) { return 0.0; }));
    return patient;
  }
  /// The tip `deep` under the skin at the origin, advancing along +y.
  std::optional<anatomy::SkinPush> frame(haptics::NeedlePhase phase, double deep,
                                         double resisting_N = 0) {
    const Pose X_DA = X_AD_.inverse();
    runtime::ToolState tool;
    tool.phase = phase;
    tool.X_DT = pack(Pose(X_DA * makePose(rotationWithZ(Vec3::UnitY()), {0.003, deep, 0.002})));
    tool.entry_D = pack(Vec3(X_DA * Vec3(0.003, 0, 0.002)));
    tool.f_contact_D = pack(Vec3(X_DA.rotation() * Vec3(0, -resisting_N, 0)));
    return follower_.follow(tool, X_AD_, now_ += kFrame);
  }
  std::optional<anatomy::SkinPush> settle(haptics::NeedlePhase phase, double deep,
                                          double resisting_N) {
    for (int i = 0; i < 60; ++i) frame(phase, deep, resisting_N);
    return frame(phase, deep, resisting_N);
  }

  const Pose X_AD_ = makePose(rotationWithZ(Vec3(1, 2, 3).normalized()), {0.1, -0.2, 0.05});
  const anatomy::Patient patient_;
  const anatomy::SurfaceQuery query_;
  SkinFollower follower_;
  std::int64_t now_ = 0;
};

using haptics::NeedlePhase;

TEST_F(Follower, BeforePunctureTheSkinIsWhereTheTipIs) {
  EXPECT_FALSE(frame(NeedlePhase::outside, -0.01));
  for (const double deep : {0.0005, 0.002, 0.004}) {
    const auto push = frame(NeedlePhase::indenting, deep);
    ASSERT_TRUE(push);
    EXPECT_LT((push->p_A - push->depth * push->n_A - Vec3(0.003, deep, 0.002)).norm(), 1e-12);
  }
  const auto above = frame(NeedlePhase::indenting, -0.0001);
  EXPECT_TRUE(!above || above->depth == 0);
}

TEST_F(Follower, PunctureLetsTheDimpleGoBackGradually) {
  frame(NeedlePhase::indenting, 0.004);
  const double first = frame(NeedlePhase::inserted, 0.0045)->depth;
  EXPECT_LT(first, 0.004);
  EXPECT_GT(first, 0.002);
  EXPECT_NEAR(settle(NeedlePhase::inserted, 0.0045, 0)->depth, 0, 1e-8);
}

TEST_F(Follower, FrictionDimplesOnTheWayInAndTentsOnTheWayOut) {
  EXPECT_NEAR(settle(NeedlePhase::inserted, 0.03, 0.3)->depth, 0.001, 1e-6);
  EXPECT_NEAR(settle(NeedlePhase::inserted, 0.03, -0.3)->depth, -0.001, 1e-6);
  EXPECT_NEAR(settle(NeedlePhase::inserted, 0.03, 50)->depth, 0.003, 1e-6);
}

TEST_F(Follower, AfterWithdrawalTheSkinIsLeftAlone) {
  settle(NeedlePhase::inserted, 0.03, -0.5);
  EXPECT_TRUE(frame(NeedlePhase::outside, -0.01));
  EXPECT_FALSE(settle(NeedlePhase::outside, -0.01, 0));
}

}  // namespace
}  // namespace palpa::task_needle

#include "apps/twin/device_twin.h"

#include <gtest/gtest.h>

#include <vector>

namespace palpa::twin {
namespace {

constexpr double kDt = 0.001;
const HandGrip kNoHand{0, 0, 0};

DeviceTruth frictionless() {
  DeviceTruth truth;
  truth.coulomb = truth.viscous = 0;
  return truth;
}

Vec3 position(const DeviceTwin& twin) { return twin.truePose().translation(); }

/// Lets a device go under a constant force; its positions every millisecond.
std::vector<Vec3> released(const DeviceTruth& truth, const Vec3& force, int ticks) {
  DeviceTwin twin(truth, Pose::Identity());
  std::vector<Vec3> path{position(twin)};
  for (int i = 0; i < ticks; ++i) {
    twin.advance(kDt, Pose::Identity(), kNoHand, force);
    path.push_back(position(twin));
  }
  return path;
}

TEST(DeviceTwin, FreeMassUnderConstantForceFollowsNewton) {
  const DeviceTruth truth = frictionless();
  const Vec3 force(0.4, -0.2, 0.1);
  const int ticks = 200;
  const std::vector<Vec3> path = released(truth, force, ticks);
  // The drives lag by tau: v(t) = F/m (t - tau (1 - exp(-t/tau))), here F/m (t - tau) to 1e-80.
  // Implicit lag and semi-implicit motion are each right to one substep of 0.25 ms.
  const double t = (ticks - 0.5) * kDt;  // the mean of a step is the speed at its middle
  const Vec3 v = (path[ticks] - path[ticks - 1]) / kDt;
  const Vec3 expected = force / truth.apparent_mass * (t - truth.actuator_tau);
  const double substep = 0.25e-3 * force.norm() / truth.apparent_mass;
  EXPECT_LT((v - expected).norm(), 2 * substep);
}

TEST(DeviceTwin, FrictionTakesNoMoreThanStatedAndNoLessThanNothing) {
  const DeviceTruth truth;
  const double force = 1.0;
  const std::vector<Vec3> path = released(truth, {force, 0, 0}, 200);
  const double v = (path[200].x() - path[199].x()) / kDt;
  const double ideal = force / truth.apparent_mass * 0.200;
  const double most_friction = truth.coulomb + truth.viscous * ideal;
  EXPECT_LT(v, ideal);
  EXPECT_GT(v, (force - most_friction) / truth.apparent_mass * (0.200 - 2 * truth.actuator_tau));
}

TEST(DeviceTwin, FrictionEndsMotion) {
  DeviceTwin twin(DeviceTruth{}, Pose::Identity());
  for (int i = 0; i < 20; ++i) twin.advance(kDt, Pose::Identity(), kNoHand, {1, 0, 0});
  for (int i = 0; i < 2000; ++i) twin.advance(kDt, Pose::Identity(), kNoHand, Vec3::Zero());
  const Vec3 before = position(twin);
  for (int i = 0; i < 1000; ++i) twin.advance(kDt, Pose::Identity(), kNoHand, Vec3::Zero());
  EXPECT_LT((position(twin) - before).norm(), 1e-9);
}

TEST(DeviceTwin, DrivesSaturate) {
  const DeviceTruth truth;
  const Vec3 direction = Vec3(1, 2, -2) / 3;
  const std::vector<Vec3> at_limit = released(truth, truth.max_force_N * direction, 50);
  const std::vector<Vec3> beyond = released(truth, 100 * direction, 50);
  for (std::size_t i = 0; i < at_limit.size(); ++i)
    EXPECT_LT((at_limit[i] - beyond[i]).norm(), 1e-12) << i;
  const std::vector<Vec3> below = released(truth, 0.9 * truth.max_force_N * direction, 50);
  EXPECT_LT(below.back().norm(), 0.95 * at_limit.back().norm());
}

TEST(DeviceTwin, RestsWithoutForce) {
  const Pose start = makePose(rotationWithZ(Vec3(1, 2, 3).normalized()), {0.1, -0.2, 0.3});
  DeviceTwin twin(DeviceTruth{}, start);
  for (int i = 0; i < 1000; ++i) twin.advance(kDt, start, HandGrip{}, Vec3::Zero());
  EXPECT_EQ(position(twin), Vec3(start.translation()));
  EXPECT_LT((twin.truePose().rotation() - start.rotation()).norm(), 1e-12);
  EXPECT_EQ(twin.gripForce(), Vec3(Vec3::Zero()));
}

TEST(DeviceTwin, HandAndPushBalanceLikeASpring) {
  const HandGrip grip;
  const Vec3 force(0, 0, 2);
  DeviceTwin twin(DeviceTruth{}, Pose::Identity());
  for (int i = 0; i < 3000; ++i) twin.advance(kDt, Pose::Identity(), grip, force);
  EXPECT_LT((position(twin) - force / grip.stiffness).norm(), 1e-6);  // 4 mm at 500 N/m
  EXPECT_LT((twin.gripForce() + force).norm(), 1e-3);
}

TEST(DeviceTwin, FollowsTheHandAndTurnsWithIt) {
  const Pose goal = makePose(rotationWithZ(Vec3(0, 1, 1).normalized()), {0.02, 0, 0});
  DeviceTwin twin(DeviceTruth{}, Pose::Identity());
  for (int i = 0; i < 3000; ++i) twin.advance(kDt, goal, HandGrip{}, Vec3::Zero());
  EXPECT_LT((position(twin) - goal.translation()).norm(), 1e-6);
  EXPECT_LT((twin.truePose().rotation() - goal.rotation()).norm(), 1e-9);
}

TEST(DeviceTwin, EncodersSpeakInWholeStepsWithinHalfAStepOfTheTruth) {
  const DeviceTruth truth;
  DeviceTwin twin(truth, Pose::Identity());
  for (int i = 0; i < 300; ++i) {
    const Pose hand = makePose(Quat(Eigen::AngleAxisd(0.002 * i, Vec3::UnitY())).toRotationMatrix(),
                               {1e-4 * i, -2e-4 * i, 5e-5 * i});
    twin.advance(kDt, hand, HandGrip{}, Vec3::Zero());
    const PackedPose read = twin.encoderPose();
    for (int k = 0; k < 3; ++k) {
      const double steps = read.p[static_cast<std::size_t>(k)] / truth.encoder_step;
      EXPECT_NEAR(steps, std::round(steps), 1e-6);
      EXPECT_LE(std::abs(read.p[static_cast<std::size_t>(k)] - position(twin)[k]),
                0.5000001 * truth.encoder_step);
    }
    const double off =
        Eigen::AngleAxisd(twin.truePose().rotation().transpose() * unpack(read.q)).angle();
    EXPECT_LE(off, 0.5 * std::sqrt(3.0) * 1.001 *
                       truth.encoder_angle);  // half a step on each of three axes
  }
}

}  // namespace
}  // namespace palpa::twin

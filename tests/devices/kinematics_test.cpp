#include "haptics/devices/falcon/falcon_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "anatomy/base/random.h"
#include "haptics/devices/falcon/falcon_driver.h"

namespace palpa::haptics {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

/// A grid over the stated workspace, its corners included.
std::vector<Vec3> workspace(int steps) {
  const DeviceCapabilities falcon = falconCapabilities();
  const Vec3 centre = unpack(falcon.workspace_centre), half = unpack(falcon.workspace_half_size);
  std::vector<Vec3> points;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      for (int k = 0; k <= steps; ++k)
        points.push_back(centre + half.cwiseProduct(Vec3(i, j, k) * (2.0 / steps) - Vec3::Ones()));
  return points;
}

TEST(FalconKinematics, OnTheAxisTheAnglesAreTheKnownOnes) {
  // Computed apart from this code, with the half-angle form of the closure equations.
  const double table[][2] = {{0.070, -26.2457}, {0.100, 8.0081},  {0.120, 23.9180},
                             {0.135, 35.3047},  {0.150, 47.2433}, {0.175, 73.4648}};
  for (const auto& [z, degrees] : table) {
    const auto legs = falconInverse({0, 0, z});
    ASSERT_TRUE(legs) << z;
    for (int leg = 0; leg < 3; ++leg) EXPECT_NEAR(legs->theta1[leg] / kDeg, degrees, 6e-5) << z;
  }
  const auto zero = falconForward(falconAngles({0, 0, 0}), kFalconCentre);
  ASSERT_TRUE(zero);
  EXPECT_NEAR(zero->p_DE.z(), 0.1346, 5e-5);
  EXPECT_NEAR(zero->p_DE.head<2>().norm(), 0, 1e-9);
}

/// The three closure equations of the header, solved for what they should be equal to.
TEST(FalconKinematics, AnglesCloseEveryLeg) {
  const double azimuth[] = {105 * kDeg, -15 * kDeg, -135 * kDeg};
  for (const Vec3& p : workspace(8)) {
    const auto legs = falconInverse(p);
    ASSERT_TRUE(legs) << p.transpose();
    for (int i = 0; i < 3; ++i) {
      const Vec3 q = Eigen::AngleAxisd(-azimuth[i], Vec3::UnitZ()) * p - Vec3(0.040, -0.02309, 0);
      const double reach = 2 * 0.01125 + 0.1025 * std::sin(legs->theta3[i]);
      EXPECT_NEAR(q.y() - 0.025, 0.1025 * std::cos(legs->theta3[i]), 1e-15);
      EXPECT_NEAR(q.x(),
                  0.060 * std::cos(legs->theta1[i]) - 0.01443 + reach * std::cos(legs->theta2[i]),
                  1e-15);
      EXPECT_NEAR(q.z(), 0.060 * std::sin(legs->theta1[i]) + reach * std::sin(legs->theta2[i]),
                  1e-15);
    }
  }
}

TEST(FalconKinematics, ForwardUndoesInverseOverTheWorkspace) {
  double worst = 0;
  for (const Vec3& p : workspace(12)) {
    const auto found = falconForward(falconInverse(p)->theta1, kFalconCentre);
    ASSERT_TRUE(found) << p.transpose();
    worst = std::max(worst, (found->p_DE - p).norm());
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(FalconKinematics, ForwardRefusesAnglesThatNoPositionHas) {
  EXPECT_FALSE(falconForward({-3, 3, 0}, kFalconCentre));
  EXPECT_FALSE(
      falconForward(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), kFalconCentre));
  EXPECT_FALSE(falconInverse({0.5, 0, 0.1}));
  EXPECT_FALSE(falconInverse(Vec3::Constant(std::numeric_limits<double>::infinity())));
}

TEST(FalconKinematics, JacobianIsTheDerivativeOfTheInverse) {
  // Central differences, extrapolated once: their error goes with the fourth power of the step and
  // is lost in the rounding of angles, 1e-16 rad / 1e-5 m against slopes of 10 rad/m.
  constexpr double kStep = 1e-5;
  RandomStream random(7, "falcon poses");
  double worst = 0;
  for (int pose = 0; pose < 300; ++pose) {
    const Vec3 p = kFalconCentre +
                   0.04 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const Mat3 J = falconJacobian(*falconInverse(p));
    for (int axis = 0; axis < 3; ++axis) {
      const auto slope = [&](double h) -> Vec3 {
        const Vec3 step = h * Vec3::Unit(axis);
        return (falconInverse(p + step)->theta1 - falconInverse(p - step)->theta1) / (2 * h);
      };
      const Vec3 truth = (4 * slope(kStep) - slope(2 * kStep)) / 3;
      for (int leg = 0; leg < 3; ++leg)
        worst = std::max(worst, std::abs(J(leg, axis) - truth[leg]) / J.row(leg).norm());
    }
  }
  EXPECT_LT(worst, 1e-6);
}

TEST(FalconKinematics, TorquesDoTheWorkOfTheForce) {
  RandomStream random(8, "falcon work");
  const auto direction = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = kFalconCentre +
                   0.04 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const Vec3 f = direction(), dp = 1e-6 * direction().normalized();
    const Vec3 tau = falconTorque(*falconInverse(p), f);
    const Vec3 dtheta = falconInverse(p + dp / 2)->theta1 - falconInverse(p - dp / 2)->theta1;
    // Both sides are |f| |dp| in size; the angles' rounding, 1e-16 of 1e-5 rad, is far below 1e-7
    // of it.
    EXPECT_NEAR(tau.dot(dtheta), f.dot(dp), 1e-7 * f.norm() * dp.norm());
  }
}

TEST(FalconKinematics, AnOutwardForceNeedsEqualTorquesOnTheAxis) {
  const Vec3 tau = falconTorque(*falconInverse({0, 0, 0.12}), {0, 0, 3});
  // d theta1/dz = 13.28 rad/m there, from differences of the inverse: a third of the force a leg.
  for (int leg = 0; leg < 3; ++leg) EXPECT_NEAR(tau[leg], 1 / 13.28, 5e-5);
  const auto counts = falconCounts(tau);
  for (const int count : counts) EXPECT_EQ(count, std::lround(-10'000 * tau[0]));
}

TEST(FalconKinematics, CountsShrinkTogether) {
  const Vec3 tau(0.9, -0.3, 0.15);
  EXPECT_EQ(falconCounts(tau), (std::array<std::int16_t, 3>{-4096, 1365, -683}));
  EXPECT_EQ(falconCounts(tau / 10), (std::array<std::int16_t, 3>{-900, 300, -150}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(falconCounts({0.1, nan, 0}), (std::array<std::int16_t, 3>{0, 0, 0}));
  EXPECT_EQ(falconCounts(Vec3::Constant(1e308)), (std::array<std::int16_t, 3>{0, 0, 0}));
}

TEST(FalconKinematics, TheMotorsGiveTheStatedForceAlongTheAxisAndLessAcross) {
  const FalconLegs legs = *falconInverse(kFalconCentre);
  const auto largestCount = [&](const Vec3& f) {
    return (10'000 * falconTorque(legs, f)).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(largestCount({0, 0, falconCapabilities().max_force_N}), 4096);
  double weakest = 1e9;
  for (int leg = 0; leg < 3; ++leg) {
    const Vec3 tau_per_N(falconTorque(legs, Vec3::UnitX())[leg],
                         falconTorque(legs, Vec3::UnitY())[leg],
                         falconTorque(legs, Vec3::UnitZ())[leg]);
    weakest = std::min(weakest, 0.4096 / tau_per_N.norm());
  }
  EXPECT_NEAR(weakest, 6.2, 0.05) << "as the README says";
}

TEST(FalconKinematics, ResolutionIsTheStepOfOneCount) {
  const Vec3 theta = falconInverse(kFalconCentre)->theta1;
  const double count = falconAngles({1, 0, 0})[0] - falconAngles({0, 0, 0})[0];
  EXPECT_NEAR(count / kDeg, 0.036435, 1e-6);
  double longest = 0;
  for (int leg = 0; leg < 3; ++leg) {
    const Vec3 next = theta + count * Vec3::Unit(leg);
    longest = std::max(longest, (falconForward(next, kFalconCentre)->p_DE - kFalconCentre).norm());
  }
  EXPECT_NEAR(falconCapabilities().position_resolution, longest, 0.01 * longest);
}

}  // namespace
}  // namespace palpa::haptics

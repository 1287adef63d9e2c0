#include "apps/twin/device_twin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "haptics/sensors/wrench_filter.h"

namespace palpa::twin {
namespace {

constexpr double kG = 9.80665;

SensorTruth quiet() {
  SensorTruth truth;
  truth.noise_N = truth.noise_Nm = 0;
  return truth;
}

TEST(SensorTwin, AtRestItShowsTheToolsWeightAndItsBias) {
  SensorTruth truth = quiet();
  truth.bias_N = {0.3, -0.2, 0.1};
  SensorTwin twin(truth, 1);
  const Pose X_WS = makePose(
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()).toRotationMatrix(), {1, 2, 3});
  haptics::WrenchSample s;
  for (int i = 0; i < 5; ++i) s = twin.measure(X_WS, Vec3::Zero(), Vec3::Zero(), 1e-3, i);
  // z of S lies along -y of W, so down is -y... of S: x stays, y of S is up.
  EXPECT_NEAR(s.f_S[0], 0.3, 1e-12);
  EXPECT_NEAR(s.f_S[1], -0.2 - truth.tool_mass * kG, 1e-9);
  EXPECT_NEAR(s.f_S[2], 0.1, 1e-9);
  EXPECT_NEAR(s.tau_S[0], truth.p_SM[2] * truth.tool_mass * kG,
              1e-9);  // (0,0,z) x (0,-w,0) = (z w, 0, 0)
}

TEST(SensorTwin, ATouchIsSeenWhereItActs) {
  SensorTwin twin(quiet(), 1);
  const Pose X_WS = makePose(Mat3::Identity(), {0, 0, 0.2});
  const haptics::WrenchSample free = twin.measure(X_WS, Vec3::Zero(), Vec3::Zero(), 1e-3, 0);
  const haptics::WrenchSample touched = twin.measure(X_WS, {1, 0, 2}, {0, 0, 0.3}, 1e-3, 1);
  EXPECT_NEAR(touched.f_S[0] - free.f_S[0], 1, 1e-12);
  EXPECT_NEAR(touched.f_S[2] - free.f_S[2], 2, 1e-12);
  EXPECT_NEAR(touched.tau_S[1] - free.tau_S[1], 0.1, 1e-12);  // (0,0,0.1) x (1,0,2) = (0, 0.1, 0)
}

TEST(SensorTwin, ItShowsNoMoreThanItsRange) {
  SensorTruth truth = quiet();
  truth.max_force_N = {5, 5, 5};
  SensorTwin twin(truth, 1);
  EXPECT_EQ(twin.measure(Pose::Identity(), {100, 0, 0}, Vec3::Zero(), 1e-3, 0).f_S[0], 5);
}

/// Newton point by point here, Newton and Euler of a rigid body in the filter: they must agree.
TEST(SensorTwin, TheFilterTakesAWavedToolOffAndLeavesTheTouch) {
  SensorTruth truth = quiet();
  SensorTwin twin(truth, 1);
  haptics::WrenchFilter filter;
  filter.low_pass = haptics::butterworth(100, 1000);
  filter.tool.mass = truth.tool_mass;
  filter.tool.p_SM = truth.p_SM;
  // Three equal masses on a rod: m/3 x 2 (l/2)^2 across it, none along.
  const double J = truth.tool_mass / 3 * 2 * std::pow(truth.tool_length / 2, 2);
  filter.tool.inertia = {J, J, 0, 0, 0, 0};
  haptics::WrenchFilterState state;
  double worst = 0, worst_torque = 0, shown = 0;
  for (std::int64_t i = 0; i < 4000; ++i) {
    const double t = 1e-3 * static_cast<double>(i);
    const Pose X_WS =
        makePose((Eigen::AngleAxisd(0.6 * std::sin(5 * t), Vec3(1, 2, 0).normalized()) *
                  Eigen::AngleAxisd(std::cos(3 * t), Vec3::UnitZ()))
                     .toRotationMatrix(),
                 {0.05 * std::sin(9 * t), 0.04 * std::cos(7 * t), 0.03 * std::sin(11 * t)});
    const Vec3 touch_W(0.5, 0, 0.8);
    const Vec3 p_W = X_WS * Vec3(0, 0, 0.1);
    const haptics::WrenchSample sample = twin.measure(X_WS, touch_W, p_W, 1e-3, i * 1'000'000);
    const haptics::ContactWrench out =
        haptics::step(filter, state, sample, pack(X_WS), i * 1'000'000);
    if (!out.valid || i < 200) continue;
    const Vec3 touch_S = X_WS.linear().transpose() * touch_W;
    worst = std::max(worst, (unpack(out.contact.f_S) - touch_S).norm());
    worst_torque =
        std::max(worst_torque, (unpack(out.contact.tau_S) - Vec3(0, 0, 0.1).cross(touch_S)).norm());
    shown = std::max(shown, (unpack(sample.f_S) - touch_S).norm());
  }
  EXPECT_GT(shown, 0.3) << "weight and inertia are there to be taken off";
  // What is left is the filter's delay of some 3 ms, in which S turns by 0.02 rad.
  EXPECT_LT(worst, 0.025);
  EXPECT_LT(worst_torque, 0.0025);
}

}  // namespace
}  // namespace palpa::twin

#include "calibration/hand_eye.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "calibration/rotation.h"
#include "tests/support/complaint.h"
#include "tests/support/test_data.h"

namespace palpa::calibration {
namespace {

using palpa::test::complaint;
using palpa::test::says;

const Pose kHandTag = makePose(rotationOf(Vec3(0.2, 1.0, -0.4)), Vec3(0.02, 0.01, 0.05));
const Pose kBaseCamera = makePose(rotationOf(Vec3(-2.0, 0.3, 0.8)), Vec3(0.4, -0.2, 0.6));

std::vector<HandEyeSample> samples(bool one_axis = false, bool still = false, int count = 20) {
  std::vector<HandEyeSample> all;
  for (int i = 0; i < count; ++i) {
    const Vec3 turn = still      ? Vec3(0.1, 0.2, 0.3)
                      : one_axis ? Vec3(0.5 * std::sin(1.1 * i), 0, 0)
                                 : Vec3(0.5 * std::sin(1.1 * i), 0.6 * std::cos(2.3 * i),
                                        0.4 * std::sin(0.7 * i + 1));
    const Pose X_DE =
        makePose(rotationOf(turn),
                 Vec3(0.1 * std::sin(0.9 * i), 0.1 * std::cos(1.9 * i), 0.05 * std::sin(3.1 * i)));
    all.push_back({X_DE, kBaseCamera.inverse() * X_DE * kHandTag});
  }
  return all;
}

TEST(HandEye, OfPerfectSamplesIsExact) {
  const HandEye found = calibrateHandEye(samples());
  EXPECT_LT((found.X_EM.matrix() - kHandTag.matrix()).norm(), 1e-8);
  EXPECT_LT((found.X_DC.matrix() - kBaseCamera.matrix()).norm(), 1e-8);
}

TEST(HandEye, WhatTheSamplesCannotTellIsNamed) {
  EXPECT_TRUE(says(complaint([] { calibrateHandEye(samples(false, false, 5)); }), "too few"));
  EXPECT_TRUE(says(complaint([] { calibrateHandEye(samples(true)); }), "one axis only"));
  EXPECT_TRUE(says(complaint([] { calibrateHandEye(samples(false, true)); }), "did not turn"));
  auto inverted = samples();
  for (HandEyeSample& s : inverted) s.X_CM = s.X_CM.inverse();
  EXPECT_TRUE(says(complaint([&] { calibrateHandEye(inverted); }), "inverse poses"))
      << complaint([&] { calibrateHandEye(inverted); });
  auto shuffled = samples();
  for (std::size_t i = 0; i + 1 < shuffled.size(); ++i)
    std::swap(shuffled[i].X_CM, shuffled[i + 1].X_CM);
  EXPECT_NE(complaint([&] { calibrateHandEye(shuffled); }), "");
  auto broken = samples();
  broken[3].X_DE.translation().x() = std::nan("");
  EXPECT_TRUE(says(complaint([&] { calibrateHandEye(broken); }), "not a number"));
}

// ros-planning/moveit_calibration (BSD-3): 50 pairs of a camera that stands still; its test expects
// this answer within 1 %.
TEST(HandEye, OfARealRobotAgreesWithWhatItsTestExpects) {
  const std::filesystem::path file = testData("handeye/pose_samples.json");
  PALPA_NEED_DATA(file);
  std::ifstream in(file);
  const nlohmann::json json = nlohmann::json::parse(in);
  const auto pose = [](const nlohmann::json& rows) {
    Pose X = Pose::Identity();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c)
        X.matrix()(r, c) =
            rows.at(static_cast<std::size_t>(r)).at(static_cast<std::size_t>(c)).get<double>();
    X.linear() = nearestRotation(X.linear());
    return X;
  };
  std::vector<HandEyeSample> all;
  for (const nlohmann::json& pair : json) all.push_back({pose(pair.at(0)), pose(pair.at(1))});
  ASSERT_EQ(all.size(), 50u);
  const HandEye found = calibrateHandEye(all);
  const Vec3 t(0.659, -0.249, 0.830);
  EXPECT_LT((found.X_DC.translation() - t).norm(), 0.01 * t.norm())
      << found.X_DC.translation().transpose();
  const Mat3 expected =
      (Eigen::AngleAxisd(0.230, Vec3::UnitX()) * Eigen::AngleAxisd(-2.540, Vec3::UnitY()) *
       Eigen::AngleAxisd(1.950, Vec3::UnitZ()))
          .toRotationMatrix();
  EXPECT_LT(rotationVector(expected.transpose() * found.X_DC.linear()).norm(), 0.01)
      << found.X_DC.linear().eulerAngles(0, 1, 2).transpose();
  std::printf("real robot: t %.4f %.4f %.4f m, left out %.2f mm, %.3f degrees, %d of 50 left out\n",
              found.X_DC.translation().x(), found.X_DC.translation().y(),
              found.X_DC.translation().z(), 1e3 * found.left_out_shift,
              found.left_out_turn * 180 / std::numbers::pi, found.fit.outliers());
}

}  // namespace
}  // namespace palpa::calibration

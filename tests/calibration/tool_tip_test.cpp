#include "calibration/tool_tip.h"

#include <cmath>
#include <numbers>
#include <random>

#include "calibration/rotation.h"
#include "tests/support/complaint.h"

namespace palpa::calibration {
namespace {

using palpa::test::complaint;
using palpa::test::says;

/// Tilted toward every side by up to `tilt`, or about x only; without noise.
std::vector<Pose> pivoting(const Vec3& tip, double tilt, bool one_axis = false, int count = 60) {
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    const double around = one_axis ? 0 : 2.4 * i, by = tilt * std::sin(0.7 * i);
    const Mat3 R = rotationOf(by * Vec3(std::cos(around), std::sin(around), 0));
    poses.push_back(makePose(R, Vec3(0.1, 0.2, 0.3) - R * tip));
  }
  return poses;
}

TEST(TipCalibration, FindsTheTipOfPerfectDataExactly) {
  const Vec3 tip(0.004, -0.002, 0.13);
  const TipCalibration found = calibrateTip(pivoting(tip, 30 * kDegree));
  EXPECT_LT((found.tip_E - tip).norm(), 1e-9);
  EXPECT_LT((found.pivot_D - Vec3(0.1, 0.2, 0.3)).norm(), 1e-9);
  EXPECT_EQ(found.fit.outliers(), 0);
}

TEST(TipCalibration, MotionAboutOneAxisIsNamedWithTheAxis) {
  const std::string words = complaint([] {
    calibrateTip(pivoting({0, 0, 0.13}, 30 * kDegree, true));
  });
  EXPECT_TRUE(says(words, "one axis only")) << words;
  EXPECT_TRUE(says(words, "(1.00, ") || says(words, "(-1.00, ")) << words;
}

TEST(TipCalibration, TooFewSamplesWanderingTipsAndNumbersThatAreNoneAreNamed) {
  EXPECT_TRUE(says(complaint([] {
                     calibrateTip(pivoting({0, 0, 0.1}, 0.5, false, 5));
                   }),
                   "too few"));
  std::vector<Pose> wandering = pivoting({0, 0, 0.1}, 0.5);
  for (std::size_t i = 0; i < wandering.size(); ++i)
    wandering[i].translation().x() += 0.02 * std::sin(static_cast<double>(i));
  EXPECT_TRUE(says(complaint([&] { calibrateTip(wandering); }), "wandered"));
  std::vector<Pose> broken = pivoting({0, 0, 0.1}, 0.5);
  broken[7].translation().y() = std::nan("");
  EXPECT_TRUE(says(complaint([&] { calibrateTip(broken); }), "not a number"));
  std::vector<Pose> skewed = pivoting({0, 0, 0.1}, 0.5);
  skewed[7].linear() *= 2;
  EXPECT_TRUE(says(complaint([&] { calibrateTip(skewed); }), "rotation"));
  // Poses the other way round pivot about the hole, too: what tells is how far away that is.
  std::vector<Pose> inverted = pivoting({0, 0, 0.1}, 0.5);
  for (Pose& X : inverted) X = X.inverse();
  EXPECT_TRUE(says(complaint([&] { calibrateTip(inverted); }), "not the other way"));
}

TEST(TipCalibration, FourOfTenGrossErrorsAreNamed) {
  std::mt19937 bits(3);
  std::normal_distribution<double> noise(0, 1e-4);
  std::vector<Pose> poses = pivoting({0, 0, 0.1}, 0.5, false, 100);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].translation() += Vec3(noise(bits), noise(bits), noise(bits));
    if (i % 5 < 2)
      poses[i].translation() += Vec3(0.03 * std::sin(3.1 * static_cast<double>(i)),
                                     0.03 * std::cos(1.7 * static_cast<double>(i)), 0.02);
  }
  EXPECT_TRUE(says(complaint([&] { calibrateTip(poses); }), "do not fit the others"));
}

std::vector<Pose> spinning(const Vec3& axis_E, double arc, double wander = 0) {
  std::vector<Pose> poses;
  const Mat3 up =
      rotationWithZ(Vec3(0.3, 0.2, -1).normalized()) * rotationWithZ(axis_E).transpose();
  for (int i = 0; i < 50; ++i)
    poses.push_back(makePose(rotationOf(wander * Vec3(std::sin(1.3 * i), std::cos(2.1 * i), 0)) *
                                 up * rotationOf(arc * i / 49 * axis_E),
                             Vec3::Zero()));
  return poses;
}

TEST(AxisCalibration, FindsTheNeedlesDirectionAndWhichWayItPoints) {
  const Vec3 axis = Vec3(0.1, -0.05, 1).normalized();
  for (const double sign : {1.0, -1.0}) {
    const AxisCalibration found = calibrateAxis(spinning(axis, 4), sign * Vec3::UnitZ());
    EXPECT_LT((found.axis_E - sign * axis).norm(), 1e-9);
    EXPECT_NEAR(found.turned, 4, 1e-6);
  }
}

TEST(AxisCalibration, ShortArcsAndWobblesAreNamed) {
  EXPECT_TRUE(says(complaint([] { calibrateAxis(spinning(Vec3::UnitZ(), 0.5), Vec3::UnitZ()); }),
                   "spun by 29 degrees only"));
  EXPECT_TRUE(
      says(complaint([] { calibrateAxis(spinning(Vec3::UnitZ(), 4, 0.15), Vec3::UnitZ()); }),
           "wandered"));
}

}  // namespace
}  // namespace palpa::calibration

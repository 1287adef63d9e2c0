#include "ar/tracking/board_pose.h"

#include <gtest/gtest.h>

#include <limits>

#include "anatomy/base/error.h"
#include "tests/ar/views.h"

namespace palpa::ar {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

TEST(BoardPose, IsExactForExactPoints) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const Pose X_CW = randomView(&random);
    const auto pose = estimateBoardPose(gridPoints(X_CW, webcam()), webcam());
    ASSERT_TRUE(pose);
    // Rounding of 600 px, 1e-13, over the board's 0.2 m and the distance of 0.5 m.
    EXPECT_LT(difference(pose->X_CW, X_CW).norm(), 1e-9);
    EXPECT_LT(pose->rms_px, 1e-8);
    EXPECT_EQ(pose->points, 96);
    EXPECT_EQ(pose->rejected, 0);
  }
}

TEST(BoardPose, CovarianceIsThatOfTheErrors) {
  std::mt19937 random(2);
  const Pose X_CW = viewOf(0.5, rad(40), rad(20));
  const int trials = 500;
  const double sigma = 0.2;
  double nees = 0;
  Mat6 spread = Mat6::Zero(), stated = Mat6::Zero();
  for (int i = 0; i < trials; ++i) {
    const auto pose =
        estimateBoardPose(gridPoints(X_CW, webcam(), sigma, &random), webcam(), sigma);
    ASSERT_TRUE(pose);
    const Vec6 d = difference(pose->X_CW, X_CW);
    nees += d.dot(pose->covariance.inverse() * d) / trials;
    spread += d * d.transpose() / trials;
    stated = pose->covariance;
  }
  // Chi-square with 6 degrees of freedom, mean of 500: standard deviation sqrt(12 / 500) = 0.15.
  EXPECT_NEAR(nees, 6, 0.6);
  // A variance from 500 samples is known to sqrt(2 / 500) = 6 %; four of these.
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(spread(i, i) / stated(i, i), 1, 0.25) << i;
}

TEST(BoardPose, ReportsTheNoiseAsReprojectionError) {
  std::mt19937 random(3);
  const auto pose =
      estimateBoardPose(gridPoints(viewOf(0.5, 0.6, 1), webcam(), 0.3, &random), webcam(), 0.3);
  ASSERT_TRUE(pose);
  // Two coordinates a point, 192 residuals less 6 parameters: 0.3 sqrt(2 * 186 / 192), known to 5
  // %.
  EXPECT_NEAR(pose->rms_px, 0.3 * std::sqrt(2 * 186.0 / 192), 0.06);
  EXPECT_GT(pose->rms_other_px, 3 * pose->rms_px);
}

/// The two solutions of one small tag far away: both must be looked at, and the better one kept.
TEST(BoardPose, PicksTheBetterOfTheTwoPlanarSolutions) {
  std::mt19937 random(4);
  const auto camera = webcam();
  int with_second = 0;
  for (int i = 0; i < 100; ++i) {
    const Pose X_CW = viewOf(0.6, rad(25 + 30 * share(&random)), rad(360 * share(&random)));
    std::vector<BoardPoint> points;
    for (const Vec3& p_W : tagCorners({1, 1, 0.06, 0.0075, 0}, 0))
      points.push_back({p_W, camera.project(X_CW * p_W)});
    const auto pose = estimateBoardPose(points, camera);
    ASSERT_TRUE(pose);
    EXPECT_LT(difference(pose->X_CW, X_CW).norm(), 1e-6);  // four points: less well conditioned
    EXPECT_GT(pose->rms_other_px, pose->rms_px);
    with_second += std::isfinite(pose->rms_other_px);
  }
  EXPECT_GT(with_second, 50) << "the second solution was not looked at";
}

TEST(BoardPose, AStrayTagDoesNotPoison) {
  std::mt19937 random(5);
  const Pose X_CW = viewOf(0.5, rad(35), rad(100));
  std::vector<BoardPoint> points = gridPoints(X_CW, webcam(), 0.1, &random);
  for (std::size_t i = 0; i < 8; ++i)
    points[i].pixel += Eigen::Vector2d(150 - 20.0 * double(i), 60);
  const auto pose = estimateBoardPose(points, webcam());
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->rejected, 8);
  EXPECT_EQ(pose->points, 88);
  EXPECT_LT((pose->X_CW.translation() - X_CW.translation()).norm(), 0.0005);
}

TEST(BoardPose, TheSamePointsGiveTheSameBits) {
  std::mt19937 random(6);
  auto points = gridPoints(viewOf(0.5, 0.7, 2), webcam(), 0.3, &random);
  points[7].pixel += Eigen::Vector2d(40, -30);
  const auto a = estimateBoardPose(points, webcam()), b = estimateBoardPose(points, webcam());
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->X_CW.matrix(), b->X_CW.matrix());
  EXPECT_EQ(a->covariance, b->covariance);
}

TEST(BoardPose, IsEmptyWhereThePointsCannotTell) {
  const auto camera = webcam();
  const Pose X_CW = viewOf(0.5, 0.5, 0.5);
  const std::vector<BoardPoint> all = gridPoints(X_CW, camera);
  EXPECT_FALSE(estimateBoardPose({}, camera));
  EXPECT_FALSE(estimateBoardPose({all.begin(), all.begin() + 3}, camera));

  std::vector<BoardPoint> line;
  for (int i = 0; i < 10; ++i)
    line.push_back({{0.01 * i, 0.02 * i, 0}, camera.project(X_CW * Vec3(0.01 * i, 0.02 * i, 0))});
  EXPECT_FALSE(estimateBoardPose(line, camera));

  std::vector<BoardPoint> broken(all.begin(), all.begin() + 4);
  broken[2].pixel.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(estimateBoardPose(broken, camera));

  std::vector<BoardPoint> one_place(all.begin(), all.begin() + 8);
  for (BoardPoint& point : one_place) point.pixel = {300, 200};
  EXPECT_FALSE(estimateBoardPose(one_place, camera));
}

/// Seen from below, as only a mirror or a wrong order of corners could.
TEST(BoardPose, IsEmptyWhenOnlyTheBackCouldBeSeen) {
  const auto camera = webcam();
  std::vector<BoardPoint> mirrored = gridPoints(viewOf(0.5, 0.4, 0), camera);
  for (BoardPoint& point : mirrored) point.p_W.x() = -point.p_W.x();
  EXPECT_FALSE(estimateBoardPose(mirrored, camera));
}

TEST(BoardPose, RefusesPointsThatAreNotOnTheBoard) {
  auto points = gridPoints(viewOf(0.5, 0.4, 0), webcam());
  points[3].p_W.z() = 0.01;
  EXPECT_THROW(estimateBoardPose(points, webcam()), Error);
}

TEST(PoseRefinement, ConvergesFromAPoorStartAndNeverGetsWorse) {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    const Pose X_CW = randomView(&random);
    Pose start = X_CW;
    const Vec3 axis = Vec3(normal(&random), normal(&random), normal(&random)).normalized();
    start.linear() = Eigen::AngleAxisd(rad(8), axis) * start.linear();
    start.translation() += 0.03 * axis;
    const RefinedPose refined = refinePose(start, gridPoints(X_CW, webcam()), webcam());
    EXPECT_LT(difference(refined.X_CW, X_CW).norm(), 1e-9);
    EXPECT_LT(refined.iterations, 50);
  }
}

}  // namespace
}  // namespace palpa::ar

#include "apps/bench/pictures/tracking_scene.h"

#include <gtest/gtest.h>

#include "ar/tracking/board_pose.h"
#include "ar/tracking/pose_filter.h"

/// What the tracking bench shows is what it says it shows.
namespace palpa::bench {
namespace {

TrackingBenchOptions small() {
  TrackingBenchOptions options;
  options.width = 640;
  options.height = 480;
  return options;
}

TEST(TrackingScene, HandMovesAtTheStatedPeakSpeedAndEndsAtRest) {
  const HandMotion hand(TrackingScene::view(0.5, 0.5, 0, 0), 0.2);
  double peak = 0;
  for (double t = 0; t < 2; t += 0.001)
    peak = std::max(peak, hand.velocity(t, Vec3::Zero()).norm());
  EXPECT_NEAR(peak, 0.2, 0.001);
  EXPECT_LT(hand.velocity(1.0, Vec3::Zero()).norm(), 1e-5);
}

TEST(TrackingScene, APictureOfAMotionShowsTheMiddleOfTheExposure) {
  const TrackingScene scene(small());
  const HandMotion hand(TrackingScene::view(0.5, 0.5, 0, 0), 0.4);
  const auto pose =
      ar::estimateBoardPose(scene.board().detect(scene.moving(hand, 0.5, 1)), scene.camera());
  ASSERT_TRUE(pose);
  EXPECT_LT(ar::difference(pose->X_CW, hand(0.5)).tail<3>().norm(),
            3e-4);  // 1 mm further a quarter of the exposure later
}

TEST(TrackingScene, ViewsStandWhereTheySay) {
  const Pose X = TrackingScene::view(0.8, 0.6, 1, 2);
  EXPECT_NEAR(X.translation().norm(), 0.8, 1e-12);
  const Vec3 camera_W = X.inverse().translation();
  EXPECT_NEAR(std::acos(camera_W.normalized().z()), 0.6, 1e-12);
}

TEST(FalsePictures, AreAlikeEveryTimeAndDifferFromEachOther) {
  for (int i = 0; i < 8; ++i) {
    const cv::Mat one = falsePicture(i, {320, 240}, 1), again = falsePicture(i, {320, 240}, 1),
                  other = falsePicture(i + 4, {320, 240}, 1);
    EXPECT_EQ(cv::norm(one, again), 0) << i;
    EXPECT_GT(cv::norm(one, other), 0) << i;
  }
}

}  // namespace
}  // namespace palpa::bench

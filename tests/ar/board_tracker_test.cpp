#include "ar/board_tracker.h"

#include <gtest/gtest.h>

#include "tests/ar/views.h"

namespace palpa::ar {
namespace {

cv::Mat pictureOf(const Pose& X_CW) {
  static const cv::Mat flat = drawTagGrid({}, 4000);
  return photograph(flat, 4000, X_CW, pinhole());
}

TEST(BoardTracker, SeesInThePartWhatItSeesInTheWhole) {
  const auto board = makeBoard(TagGridSpec{});
  BoardTracker tracker(*board, pinhole());
  for (int i = 0; i < 6; ++i) {
    const Pose X_CW = viewOf(0.6 + 0.01 * i, rad(35), rad(5.0 * i));
    const cv::Mat picture = pictureOf(X_CW);
    const auto whole = estimateBoardPose(board->detect(picture), pinhole());
    const auto part = tracker.see(picture);
    ASSERT_TRUE(whole && part);
    EXPECT_EQ(part->points, whole->points);
    // Same corners, found in a part that is thresholded alike: a few thousandths of a pixel.
    EXPECT_LT((part->X_CW.translation() - whole->X_CW.translation()).norm(), 2e-5);
    EXPECT_LT(tracker.region().area(), 0.6 * picture.total());
    EXPECT_FALSE(tracker.region().empty());
  }
}

TEST(BoardTracker, FindsTheBoardAgainAnywhere) {
  const auto board = makeBoard(TagGridSpec{});
  BoardTracker tracker(*board, pinhole());
  Pose left = viewOf(0.9, rad(20), 0), right = left;
  left.translation().x() -= 0.15;
  right.translation().x() += 0.15;
  ASSERT_TRUE(tracker.see(pictureOf(left)));
  const cv::Rect before = tracker.region();
  const auto jumped = tracker.see(pictureOf(right));
  ASSERT_TRUE(jumped);
  EXPECT_LT((jumped->X_CW.translation() - right.translation()).norm(), 1e-3);
  EXPECT_GT(tracker.region().x, before.x + 80);
}

TEST(BoardTracker, ForgetsALostBoardAndTakesPicturesOfAnySize) {
  const auto board = makeBoard(TagGridSpec{});
  BoardTracker tracker(*board, pinhole());
  ASSERT_TRUE(tracker.see(pictureOf(viewOf(0.6, rad(30), 0))));
  EXPECT_FALSE(tracker.see(cv::Mat(480, 640, CV_8U, cv::Scalar(128))));
  EXPECT_TRUE(tracker.region().empty());
  ASSERT_TRUE(tracker.see(pictureOf(viewOf(0.6, rad(30), 0))));
  EXPECT_FALSE(tracker.see(cv::Mat(60, 80, CV_8U, cv::Scalar(128))));
}

}  // namespace
}  // namespace palpa::ar

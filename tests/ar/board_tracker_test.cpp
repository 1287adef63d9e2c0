#include "ar/tracking/board_tracker.h"

#include <gtest/gtest.h>

#include "tests/ar/views.h"

namespace palpa::ar {
namespace {

cv::Mat pictureOf(const Pose& X_CW) {
  static const cv::Mat flat = drawTagGrid({}, 4000);
  return photograph(flat, 4000, X_CW, pinhole());
}

constexpr std::int64_t kFrame = 33'333'333;

TEST(BoardTracker, SeesInThePartWhatItSeesInTheWhole) {
  const auto board = makeBoard(TagGridSpec{});
  BoardTracker tracker(*board, pinhole());
  for (int i = 0; i < 6; ++i) {
    const Pose X_CW = viewOf(0.6 + 0.002 * i, rad(35), rad(1.0 * i));
    const cv::Mat picture = pictureOf(X_CW);
    const auto whole = estimateBoardPose(board->detect(picture), pinhole());
    const auto part = tracker.see(picture, i * kFrame);
    ASSERT_TRUE(whole && part);
    EXPECT_EQ(part->points, whole->points);
    // Same corners, found in a part that is thresholded alike: a few thousandths of a pixel.
    EXPECT_LT((part->X_CW.translation() - whole->X_CW.translation()).norm(), 2e-5);
    EXPECT_EQ(tracker.region().empty(), i == 0);
    EXPECT_LT(tracker.region().area(),
              (i > 2 ? 0.6 : 1.0) * picture.total());  // at first its speed is not known
  }
}

/// A jump is believed when the second picture says the same.
TEST(BoardTracker, FindsTheBoardAgainAnywhereInTwoPictures) {
  const auto board = makeBoard(TagGridSpec{});
  BoardTracker tracker(*board, pinhole());
  Pose left = viewOf(0.9, rad(20), 0), right = left;
  left.translation().x() -= 0.15;
  right.translation().x() += 0.15;
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(tracker.see(pictureOf(left), i * kFrame));
  EXPECT_FALSE(tracker.see(pictureOf(right), 5 * kFrame));
  EXPECT_EQ(tracker.state(), TrackState::coasting);
  const auto jumped = tracker.see(pictureOf(right), 6 * kFrame);
  ASSERT_TRUE(jumped);
  EXPECT_LT((jumped->X_CW.translation() - right.translation()).norm(), 1e-3);
  EXPECT_EQ(tracker.state(), TrackState::tracked);
}

TEST(BoardTracker, HiddenLostAndFoundAgainInPicturesOfAnySize) {
  const auto board = makeBoard(TagGridSpec{});
  BoardTracker tracker(*board, pinhole());
  const cv::Mat seen = pictureOf(viewOf(0.6, rad(30), 0)),
                nothing(480, 640, CV_8U, cv::Scalar(128));
  EXPECT_FALSE(tracker.see(nothing, 0));
  EXPECT_EQ(tracker.state(), TrackState::searching);
  ASSERT_TRUE(tracker.see(seen, 1 * kFrame));
  EXPECT_FALSE(tracker.see(nothing, 2 * kFrame));
  EXPECT_EQ(tracker.state(), TrackState::coasting);
  EXPECT_FALSE(tracker.see(nothing, 20 * kFrame));
  EXPECT_EQ(tracker.state(), TrackState::lost);
  EXPECT_FALSE(tracker.see(cv::Mat(60, 80, CV_8U, cv::Scalar(128)), 21 * kFrame));
  ASSERT_TRUE(tracker.see(seen, 22 * kFrame));
  EXPECT_EQ(tracker.state(), TrackState::tracked);
}

/// Points that were found elsewhere mean the same as the picture that they were found in.
TEST(BoardTracker, TakesPointsAsItTakesPictures) {
  const auto board = makeBoard(TagGridSpec{});
  const cv::Mat nothing(480, 640, CV_8U, cv::Scalar(128));
  BoardTracker seeing(*board, pinhole()), taking(*board, pinhole());
  for (int i = 0; i < 20; ++i) {
    const bool hidden = i > 5 && i < 18;  // for a moment, then lost
    const cv::Mat picture = hidden ? nothing : pictureOf(viewOf(0.27, rad(10), 0));
    const auto seen = seeing.see(picture, i * kFrame),
               taken = taking.take(board->detect(picture), i * kFrame);
    ASSERT_TRUE(seeing.region().empty());  // a near board: the whole picture is looked at
    ASSERT_EQ(seen.has_value(), taken.has_value()) << i;
    if (seen) {
      EXPECT_EQ(seen->X_CW.matrix(), taken->X_CW.matrix());
    }
    EXPECT_EQ(seeing.state(), taking.state());
    EXPECT_EQ(seeing.track().at(i * kFrame).X.matrix(), taking.track().at(i * kFrame).X.matrix());
  }
}

TEST(BoardTracker, PhotographsStandForThemselves) {
  const auto board = makeBoard(TagGridSpec{});
  BoardTracker tracker(*board, pinhole(), {{}, false});
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(tracker.see(pictureOf(viewOf(0.5 + 0.1 * i, rad(15 * i), rad(80 * i))), i * kFrame))
        << i;
}

/// One tag of a grid is believed where the grid is expected, and nowhere else.
TEST(BoardTracker, ALoneTagIsBelievedOnlyWhereItIsExpected) {
  const auto board = makeBoard(TagGridSpec{});
  const Pose X_CW = viewOf(0.5, rad(30), 0);
  const cv::Mat whole = pictureOf(X_CW);
  // All but one tag hidden.
  cv::Mat lone(whole.size(), CV_8U, cv::Scalar(120));
  Eigen::AlignedBox2d box;
  for (const Vec3& p_W : tagCorners({}, 9)) box.extend(pinhole().project(X_CW * p_W));
  const cv::Rect around(cv::Point(int(box.min().x()) - 6, int(box.min().y()) - 6),
                        cv::Point(int(box.max().x()) + 7, int(box.max().y()) + 7));
  whole(around).copyTo(lone(around));
  ASSERT_EQ(board->detect(lone).size(), 4u);
  BoardTracker stranger(*board, pinhole());
  EXPECT_FALSE(stranger.see(lone, 0));
  BoardTracker tracker(*board, pinhole());
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(tracker.see(whole, i * kFrame));
  const auto seen = tracker.see(lone, 10 * kFrame);
  ASSERT_TRUE(seen);
  EXPECT_LT(difference(tracker.track().at(10 * kFrame).X, X_CW).tail<3>().norm(), 1e-3);
}

}  // namespace
}  // namespace palpa::ar

#include "ar/boards/chessboard.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/ar/views.h"

namespace palpa::ar {
namespace {

constexpr double kPxPerM = 2000, kSquare = 0.02;

/// `columns` x `rows` inner corners on white paper; the square at the lower left is black, and so
/// is the one inside the first corner. The middle of the inner corners is the middle of the
/// picture.
cv::Mat drawChessboard(int columns, int rows) {
  const int side = int(kSquare * kPxPerM);
  cv::Mat paper((rows + 3) * side, (columns + 3) * side, CV_8U, cv::Scalar(235));
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column)
      if ((row + column) % 2 == 0)
        paper(cv::Rect((column + 1) * side, (rows + 1 - row) * side, side, side)) = 20;
  return paper;
}

/// From every side: what the camera's place is must come out, also when the board is upside down.
TEST(Chessboard, TheColoursTellWhichEndIsWhich) {
  const auto camera = pinhole();
  for (const cv::Size size : {cv::Size(9, 6), cv::Size(6, 9), cv::Size(7, 4)}) {
    const cv::Mat paper = drawChessboard(size.width, size.height);
    const Chessboard board(size, kSquare);
    for (int i = 0; i < 8; ++i) {
      const Pose X_CW = viewOf(0.45, rad(30), rad(45 * i + 10), rad(15 * i));
      const auto points = board.detect(photograph(paper, kPxPerM, X_CW, camera));
      ASSERT_EQ(points.size(), std::size_t(size.area())) << size << i;
      const auto pose = estimateBoardPose(points, camera);
      ASSERT_TRUE(pose) << size << i;
      EXPECT_LT(difference(pose->X_CW, X_CW).head<3>().norm(), rad(0.1)) << size << i;
      EXPECT_LT((pose->X_CW.translation() - X_CW.translation()).norm(), 0.0005) << size << i;
      EXPECT_LT(pose->rms_px, 0.1);
    }
  }
}

/// 8 x 6 looks the same after half a turn: +x must point right in the picture, whichever way round
/// the paper lies, and the pose must be the true one or the true one after half a turn.
TEST(Chessboard, WhereTheColoursCannotTellXPointsRight) {
  const auto camera = pinhole();
  const cv::Mat paper = drawChessboard(8, 6);
  const Chessboard board({8, 6}, kSquare);
  const Pose half_turn =
      makePose(Eigen::AngleAxisd(rad(180), Vec3::UnitZ()).toRotationMatrix(), {0, 0, 0});
  for (int i = 0; i < 8; ++i) {
    const Pose X_CW = viewOf(0.45, rad(30), rad(45 * i + 10));
    const auto points = board.detect(photograph(paper, kPxPerM, X_CW, camera));
    ASSERT_EQ(points.size(), 48U);
    const auto pose = estimateBoardPose(points, camera);
    ASSERT_TRUE(pose);
    EXPECT_GT(pose->X_CW.linear()(0, 0), 0);
    const double one = difference(pose->X_CW, X_CW).head<3>().norm();
    const double other = difference(pose->X_CW, X_CW * half_turn).head<3>().norm();
    EXPECT_LT(std::min(one, other), rad(0.1));
  }
}

TEST(Chessboard, WIsItsMiddle) {
  const auto camera = pinhole();
  const auto points =
      Chessboard({9, 6}, kSquare)
          .detect(photograph(drawChessboard(9, 6), kPxPerM, viewOf(0.4, 0, 0), camera));
  ASSERT_EQ(points.size(), 54U);
  Vec3 sum = Vec3::Zero();
  for (const BoardPoint& point : points) sum += point.p_W;
  EXPECT_LT(sum.norm(), 1e-12);
  EXPECT_LT((points[0].p_W - Vec3(-0.08, -0.05, 0)).norm(), 1e-12);
  EXPECT_LT((points[1].p_W - Vec3(-0.06, -0.05, 0)).norm(), 1e-12);
}

TEST(Chessboard, IsNotSeenWhereThereIsNone) {
  const Chessboard board({9, 6}, kSquare);
  EXPECT_TRUE(board.detect(cv::Mat(480, 640, CV_8U, cv::Scalar(128))).empty());
  EXPECT_TRUE(board.detect(cv::Mat(8, 8, CV_8U, cv::Scalar(128))).empty());
  const cv::Mat other = photograph(drawChessboard(7, 5), kPxPerM, viewOf(0.4, 0.3, 0), pinhole());
  EXPECT_TRUE(board.detect(other).empty());
}

}  // namespace
}  // namespace palpa::ar

#include "ar/boards/charuco.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "ar/boards/opencv_aruco.h"
#include "tests/ar/lens.h"
#include "tests/support/counts.h"

namespace palpa::ar {
namespace {

constexpr double kPrint = 3200;
const char* const kCharuco = "charuco:7x5:0.030:0.022:DICT_5X5_100";

/// What we draw is what OpenCV draws: layout, ids and bits, for odd and even numbers of rows.
TEST(Charuco, IsDrawnAsOpenCVDrawsIt) {
  for (const CharucoSpec& spec :
       {CharucoSpec{7, 5, 0.030, 0.021, "DICT_5X5_100"}, CharucoSpec{6, 8, 0.030, 0.018}}) {
    const cv::Mat ours = pictureOf(sheetOf(spec), 1000);  // 3 px a cell, 30 px a square
    cv::Mat theirs;
    aruco::draw(charucoLayout(spec), ours.size(), 30, &theirs);
    ASSERT_EQ(ours.size(), theirs.size());
    // OpenCV rounds a marker's place on the sheet; ours is shared between two pixels there.
    cv::Mat different;
    cv::absdiff(ours, theirs, different);
    EXPECT_LT(cv::countNonZero(different > 128), int(0.02 * double(ours.total())));
  }
}

/// From every side, tilted by up to 49 degrees, through a lens: corners where the truth has them,
/// so W is where it is defined to be.
TEST(Charuco, CornersAreFoundToAFewHundredthsOfAPixel) {
  for (const char* word :
       {kCharuco, "charuco:8x6:0.025:0.018", "charuco:5x7:0.030:0.022:DICT_6X6_250"}) {
    const auto board = makeBoard(word);
    const cv::Mat flat = drawBoard(word, kPrint);
    const std::size_t corners = board->detect(snapshot(flat, kPrint, viewOf(0.45, 0, 0))).size();
    EXPECT_TRUE(corners == 24 || corners == 35) << word;
    for (const double distance : {0.35, 0.5}) {
      if (distance < 0.5 && word != std::string(kCharuco) && !test::fullCounts()) continue;
      const auto seen = accuracy(*board, flat, kPrint, distance);
      EXPECT_GT(seen.points, 8 * corners * 9 / 10) << word;
      EXPECT_LT(seen.median_px, 0.15) << word;  // 0.02 to 0.04
      EXPECT_LT(seen.worst_px, 0.5) << word;
    }
  }
}

TEST(Charuco, WIsItsMiddle) {
  const auto points = makeBoard(kCharuco)->detect(
      snapshot(drawBoard(kCharuco, kPrint), kPrint, viewOf(0.4, rad(20), rad(70))));
  ASSERT_EQ(points.size(), 24U);
  Vec3 sum = Vec3::Zero();
  for (const BoardPoint& point : points) sum += point.p_W;
  EXPECT_LT(sum.norm(), 1e-6);  // OpenCV's board is in single precision
  EXPECT_LT((points[0].p_W - Vec3(-0.075, 0.045, 0)).norm(), 1e-6);
  EXPECT_LT((points[1].p_W - Vec3(-0.045, 0.045, 0)).norm(), 1e-6);
  EXPECT_LT((points[23].p_W - Vec3(0.075, -0.045, 0)).norm(), 1e-6);
}

TEST(Charuco, HalfOutsideThePictureTheRestIsTrue) {
  const auto board = makeBoard(kCharuco);
  const cv::Mat flat = drawBoard(kCharuco, kPrint);
  for (const double azimuth : {0.0, 100.0, 250.0}) {
    const Pose X_CW = test::lookAt({0.10, 0, 0}, 0.22, rad(20), rad(azimuth), rad(10));
    const auto points = board->detect(snapshot(flat, kPrint, X_CW));
    EXPECT_GE(points.size(), 6U) << azimuth;
    EXPECT_LT(points.size(), 24U) << azimuth;
    EXPECT_LT(errors(points, X_CW).back(), 0.5) << azimuth;
  }
}

TEST(Charuco, SeesWhatIsNotCovered) {
  const Pose X_CW = viewOf(0.4, rad(20), 0);
  cv::Mat picture = snapshot(drawBoard(kCharuco, kPrint), kPrint, X_CW);
  const cv::Rect hand(0, 0, 320, 480);
  cv::rectangle(picture, hand, 90, cv::FILLED);
  const auto points = makeBoard(kCharuco)->detect(picture);
  EXPECT_GE(points.size(), 8U);
  for (const BoardPoint& point : points) EXPECT_GT(point.pixel.x(), 320);
  EXPECT_LT(errors(points, X_CW).back(), 0.5);
}

/// As OpenCV before 4.6 drew it, the lower left square black.
cv::Mat drawnBefore46(const CharucoSpec& spec, double px_per_m) {
  const int square = int(spec.square * px_per_m), marker = int(spec.marker * px_per_m);
  const int gap = (square - marker) / 2;
  const aruco::CharucoPattern layout = charucoLayout(spec);
  cv::Mat sheet((spec.rows + 2) * square, (spec.columns + 2) * square, CV_8U, cv::Scalar(255));
  int id = 0;
  for (int row = 0; row < spec.rows; ++row)
    for (int col = 0; col < spec.columns; ++col) {
      cv::Mat here = sheet(cv::Rect((col + 1) * square, (row + 1) * square, square, square));
      cv::Mat drawn;
      aruco::drawMarker(layout.dictionary, id, marker, &drawn);
      if ((spec.rows - 1 - row + col) % 2 == 0)
        here = 0;
      else
        drawn.copyTo(here(cv::Rect(gap, gap, marker, marker)));
      id += (spec.rows - 1 - row + col) % 2;
    }
  return sheet;
}

TEST(Charuco, TheLayoutBeforeOpenCV46IsNotTakenForOurs) {
  for (const CharucoSpec& spec : {CharucoSpec{7, 4, 0.030, 0.021}, CharucoSpec{6, 4, 0.030, 0.021},
                                  CharucoSpec{5, 6, 0.030, 0.021}}) {
    const CharucoBoard board(spec);
    const Pose X_CW = viewOf(0.4, rad(15), rad(30));
    const cv::Mat older = snapshot(drawnBefore46(spec, 2000), 2000, X_CW);
    const cv::Mat ours = snapshot(pictureOf(sheetOf(spec), 2000), 2000, X_CW);
    EXPECT_TRUE(board.detect(older).empty()) << spec.columns;
    EXPECT_EQ(board.detect(ours).size(), std::size_t((spec.columns - 1) * (spec.rows - 1)));
  }
}

TEST(Charuco, WithAnOddNumberOfRowsTheLayoutsAreOne) {
  const CharucoSpec spec{7, 5, 0.030, 0.021};
  const Pose X_CW = viewOf(0.4, rad(15), rad(30));
  const auto points = CharucoBoard(spec).detect(snapshot(drawnBefore46(spec, 2000), 2000, X_CW));
  EXPECT_EQ(points.size(), 24U);
  EXPECT_LT(errors(points, X_CW).back(), 0.5);
}

TEST(Charuco, IsNotSeenWhereThereIsNone) {
  const auto board = makeBoard(kCharuco);
  EXPECT_TRUE(board->detect(cv::Mat(480, 640, CV_8U, cv::Scalar(128))).empty());
  EXPECT_TRUE(board->detect(cv::Mat(8, 8, CV_8U, cv::Scalar(128))).empty());
  const Pose X_CW = viewOf(0.4, rad(20), 0);
  const char* const other = "charuco:7x5:0.030:0.022:DICT_6X6_100";
  EXPECT_TRUE(board->detect(snapshot(drawBoard(other, kPrint), kPrint, X_CW)).empty());
  EXPECT_THROW(board->detect(cv::Mat()), Error);
}

}  // namespace
}  // namespace palpa::ar

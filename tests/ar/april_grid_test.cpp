#include "ar/boards/april_grid.h"

#include <gtest/gtest.h>

#include <set>

#include "anatomy/base/error.h"
#include "ar/boards/tag_grid.h"
#include "tests/ar/lens.h"

namespace palpa::ar {
namespace {

constexpr double kSheetPxPerM = 2000;  // 60 px a tag, 18 px a gap: tags can be turned on the sheet
constexpr int kTag = 60, kGap = 18;

TagGridSpec gridOf(int border_bits, bool squares) {
  return {6, 4, 0.030, 0.009, 0, border_bits, squares};
}

/// Where tag (column, row from below) lies on the drawing with corner squares.
cv::Rect onSheet(int column, int row) {
  return {2 * kGap + column * (kTag + kGap), 2 * kGap + (3 - row) * (kTag + kGap), kTag, kTag};
}

TEST(TagFamily, ABorderOfTwoCellsKeepsTheCodes) {
  const TagFamily one = makeTagFamily(1), two = makeTagFamily(2);
  EXPECT_EQ(one->width_at_border, 8);
  EXPECT_EQ(two->width_at_border, 10);
  EXPECT_EQ(one->codes[7], two->codes[7]);
  for (unsigned i = 0; i < 36; ++i) {
    EXPECT_EQ(two->bit_x[i], one->bit_x[i] + 1);
    EXPECT_EQ(two->bit_y[i], one->bit_y[i] + 1);
  }
  EXPECT_THROW(makeTagFamily(0), UsageError);
  EXPECT_THROW(makeTagFamily(3), UsageError);
}

/// Tag 0 as Kalibr prints it: its code 0xd5d628584 row by row from the upper left, white where set.
TEST(TagFamily, LooksAsKalibrPrintsIt) {
  const cv::Mat paper = drawTagGrid({1, 1, 0.10, 0.02, 0, 2, false}, 100);  // a pixel a cell
  ASSERT_EQ(paper.size(), cv::Size(14, 14));
  for (int i = 0; i < 36; ++i) {
    const bool white = (0xd5d628584ULL >> (35 - i)) & 1U;
    EXPECT_EQ(paper.at<uchar>(4 + i / 6, 4 + i % 6), white ? 255 : 0) << i;
  }
}

std::vector<BoardPoint> seenAs(const TagGridSpec& sought, const TagGridSpec& drawn) {
  const cv::Mat flat = drawTagGrid(drawn, kSheetPxPerM);
  const auto board = makeBoard(sought, 1);
  std::vector<BoardPoint> all;
  for (int i = 0; i < 8; ++i) {
    const Pose X_CW = viewOf(0.4, rad(7 * i), rad(45 * i), rad(50 * i));
    const auto points = board->detect(snapshot(flat, kSheetPxPerM, X_CW));
    for (const double error : errors(points, X_CW)) EXPECT_LT(error, 0.5);  // never a wrong id
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

/// A narrow border is found in a wide one's place never; the other way the inner bits fall on their
/// cells, and some tags (two of five) decode, each with its own id.
TEST(TagFamily, TheOtherBorderIsNotFoundOrSeldomAndNeverWrong) {
  EXPECT_EQ(seenAs(gridOf(1, false), gridOf(1, false)).size(), 8U * 96);
  EXPECT_EQ(seenAs(gridOf(2, false), gridOf(2, false)).size(), 8U * 96);
  EXPECT_TRUE(seenAs(gridOf(1, false), gridOf(2, false)).empty());
  EXPECT_LT(seenAs(gridOf(2, false), gridOf(1, false)).size(), 8U * 96 / 2);
}

TEST(TagFamily, BothBordersAreEquallyAccurate) {
  for (const int border : {1, 2}) {
    const TagGridSpec spec = gridOf(border, false);
    const auto seen =
        accuracy(*makeBoard(spec, 1), drawTagGrid(spec, kSheetPxPerM), kSheetPxPerM, 0.4);
    EXPECT_EQ(seen.points, 8U * 96) << border;
    EXPECT_LT(seen.median_px, 0.15) << border;  // 0.06 and 0.05
  }
}

/// Sharpened pictures let more tags of the other border decode; what is found is right all the
/// same.
TEST(AprilGrid, ASheetWithTheOtherBorderIsNeverWrong) {
  for (const int border : {1, 2}) {
    const std::size_t own = seenAs(gridOf(border, true), gridOf(border, true)).size();
    EXPECT_GT(own, 8U * 96 * 9 / 10) << border;
    EXPECT_LT(seenAs(gridOf(3 - border, true), gridOf(border, true)).size(), own) << border;
  }
}

/// From every side, tilted by up to 49 degrees; a tag or two may be missed in the steepest views.
TEST(AprilGrid, CornersAreFoundToAFewHundredthsOfAPixel) {
  for (const int border : {1, 2}) {
    const cv::Mat flat = drawTagGrid(gridOf(border, true), 3200);
    for (const double distance : {0.35, 0.5}) {
      const auto seen = accuracy(*makeBoard(gridOf(border, true)), flat, 3200, distance);
      EXPECT_GT(seen.points, 8U * 96 * 9 / 10) << border;
      EXPECT_LT(seen.median_px, 0.15) << border;  // 0.02 to 0.04
      EXPECT_LT(seen.worst_px, 0.5) << border;
      RecordProperty("median_px_" + std::to_string(border), std::to_string(seen.median_px));
    }
  }
}

/// The library alone finds barely half of these tags: the squares join their outlines.
TEST(AprilGrid, SurvivesBlurThatJoinsTheSquares) {
  const cv::Mat flat = drawTagGrid(gridOf(2, true), 3200);
  const auto seen = accuracy(*makeBoard(gridOf(2, true)), flat, 3200, 0.4, {1.2, 4});
  EXPECT_GT(seen.points, 8U * 96 * 3 / 4);
  EXPECT_LT(seen.median_px, 0.15);
}

TEST(AprilGrid, TurnedTagsDoNotMixUpCorners) {
  const cv::Mat sheet = drawTagGrid(gridOf(2, true), kSheetPxPerM);
  const auto board = makeBoard(gridOf(2, true));
  for (int turn = 0; turn < 4; ++turn) {
    cv::Mat turned = sheet.clone();
    for (int i = 0; turn > 0 && i < 24; ++i) {
      const cv::Mat tag = sheet(onSheet(i % 6, i / 6)).clone();
      cv::rotate(tag, turned(onSheet(i % 6, i / 6)), turn - 1);  // 90, 180, 270 degrees
    }
    const Pose X_CW = viewOf(0.4, rad(30), rad(80 * turn + 20), rad(60));
    const auto points = board->detect(snapshot(turned, kSheetPxPerM, X_CW));
    EXPECT_GT(points.size(), 84U) << turn;
    EXPECT_LT(errors(points, X_CW).back(), 0.5) << turn;
  }
}

/// Ids that run from the upper left are another sheet: no turn makes it ours.
TEST(AprilGrid, ASheetNumberedFromTheOtherSideIsNotSeen) {
  const cv::Mat sheet = drawTagGrid(gridOf(2, true), kSheetPxPerM);
  cv::Mat other = sheet.clone();
  for (int i = 0; i < 24; ++i)
    sheet(onSheet(i % 6, i / 6)).copyTo(other(onSheet(i % 6, 3 - i / 6)));
  const auto board = makeBoard(gridOf(2, true));
  const Pose X_CW = viewOf(0.4, rad(15), 0);
  EXPECT_GT(board->detect(snapshot(sheet, kSheetPxPerM, X_CW)).size(), 90U);
  EXPECT_TRUE(board->detect(snapshot(other, kSheetPxPerM, X_CW)).empty());
}

TEST(AprilGrid, ATagAtAForeignPlaceIsLeftOut) {
  cv::Mat sheet = drawTagGrid(gridOf(2, true), kSheetPxPerM);
  const cv::Mat far = drawTagGrid({2, 1, 0.030, 0.009, 22, 2, true}, kSheetPxPerM);  // ids 22, 23
  far(cv::Rect(2 * kGap + kTag + kGap, 2 * kGap, kTag, kTag)).copyTo(sheet(onSheet(0, 0)));
  cv::rectangle(sheet, onSheet(5, 3), 255, cv::FILLED);  // the true 23
  const Pose X_CW = viewOf(0.4, rad(15), 0);
  const auto points = makeBoard(gridOf(2, true))->detect(snapshot(sheet, kSheetPxPerM, X_CW));
  EXPECT_GT(points.size(), 80U);
  EXPECT_LT(errors(points, X_CW).back(), 0.5);
}

/// One tag cannot tell how it is turned; two can.
TEST(AprilGrid, ALoneTagIsNotEnough) {
  for (const std::set<int>& shown : {std::set<int>{8}, std::set<int>{8, 9}, std::set<int>{2, 21}}) {
    cv::Mat sheet = drawTagGrid(gridOf(2, true), kSheetPxPerM);
    for (int i = 0; i < 24; ++i)
      if (!shown.contains(i)) cv::rectangle(sheet, onSheet(i % 6, i / 6), 255, cv::FILLED);
    const Pose X_CW = viewOf(0.4, rad(15), rad(20));
    const auto points = makeBoard(gridOf(2, true))->detect(snapshot(sheet, kSheetPxPerM, X_CW));
    EXPECT_EQ(points.size(), shown.size() == 1 ? 0U : 8U);
    for (const double error : errors(points, X_CW)) EXPECT_LT(error, 0.5);
  }
}

TEST(AprilGrid, HalfOutsideThePictureTheRestIsTrue) {
  const cv::Mat flat = drawTagGrid(gridOf(2, true), 3200);
  const auto board = makeBoard(gridOf(2, true));
  for (const double azimuth : {0.0, 100.0, 250.0}) {
    const Pose X_CW = test::lookAt({0.115, 0, 0}, 0.25, rad(20), rad(azimuth), rad(10));
    const auto points = board->detect(snapshot(flat, 3200, X_CW));
    EXPECT_GT(points.size(), 20U) << azimuth;
    EXPECT_LT(points.size(), 80U) << azimuth;
    EXPECT_LT(errors(points, X_CW).back(), 0.5) << azimuth;
  }
}

/// A hand over some tags, and a sheet cut off at its outer tags: no crossing, no corner.
TEST(AprilGrid, CornersWithoutTheirSquareAreLeftOut) {
  cv::Mat sheet = drawTagGrid(gridOf(2, true), kSheetPxPerM);
  sheet.colRange(0, 2 * kGap) = 255;  // squares left of the first column
  const Pose X_CW = viewOf(0.4, rad(15), rad(20));
  const auto points = makeBoard(gridOf(2, true))->detect(snapshot(sheet, kSheetPxPerM, X_CW));
  EXPECT_GT(points.size(), 80U);
  for (const BoardPoint& point : points) EXPECT_GT(point.p_W.x(), -0.11);  // those at -0.1125
  EXPECT_LT(errors(points, X_CW).back(), 0.5);
}

TEST(AprilGrid, AnIdSeenAtTwoPlacesIsLeftOut) {
  cv::Mat sheet = drawTagGrid(gridOf(2, true), kSheetPxPerM);
  sheet(onSheet(0, 0)).copyTo(sheet(onSheet(5, 3)));  // id 0 where 23 belongs
  const Pose X_CW = viewOf(0.4, 0, 0);
  const auto points = makeBoard(gridOf(2, true))->detect(snapshot(sheet, kSheetPxPerM, X_CW));
  EXPECT_EQ(points.size(), 22U * 4);
  EXPECT_LT(errors(points, X_CW).back(), 0.5);
}

/// Large pictures are looked at in halves, too, and their corners located in the whole.
TEST(AprilGrid, LargeBlurredPicturesAreSearchedAtSeveralScales) {
  cv::Mat large;
  cv::resize(
      snapshot(drawTagGrid(gridOf(2, true), 3200), 3200, viewOf(0.4, rad(20), rad(30)), {0, 0}),
      large, {}, 4, 4, cv::INTER_CUBIC);
  cv::GaussianBlur(large, large, {0, 0}, 3);
  const auto points = makeBoard(gridOf(2, true))->detect(large);
  EXPECT_GT(points.size(), 86U);
  const Pose X_CW = viewOf(0.4, rad(20), rad(30));
  for (const BoardPoint& point : points) {
    const Eigen::Vector2d seen = (point.pixel - Eigen::Vector2d(1.5, 1.5)) / 4;
    EXPECT_LT((seen - webcam().project(X_CW * point.p_W)).norm(), 0.5);
  }
}

TEST(AprilGrid, TakesColourAndRefusesWhatIsNoPicture) {
  const cv::Mat gray =
      snapshot(drawTagGrid(gridOf(2, true), kSheetPxPerM), kSheetPxPerM, viewOf(0.4, 0, 0));
  cv::Mat colour;
  cv::cvtColor(gray, colour, cv::COLOR_GRAY2BGR);
  const auto board = makeBoard(gridOf(2, true));
  EXPECT_EQ(board->detect(gray).size(), board->detect(colour).size());
  EXPECT_THROW(board->detect(cv::Mat()), Error);
  EXPECT_TRUE(board->detect(cv::Mat(480, 640, CV_8U, cv::Scalar(128))).empty());
}

}  // namespace
}  // namespace palpa::ar

#include "ar/boards/tag_grid.h"

#include <gtest/gtest.h>

#include <map>

#include "anatomy/base/error.h"
#include "tests/ar/views.h"

namespace palpa::ar {
namespace {

/// On paper: pixel centres at whole numbers, the picture's middle is W's origin, +y is up.
Eigen::Vector2d onPaper(const Vec3& p_W, const cv::Mat& paper, double px_per_m) {
  return {(paper.cols - 1) / 2.0 + p_W.x() * px_per_m, (paper.rows - 1) / 2.0 - p_W.y() * px_per_m};
}

cv::Mat framed(const cv::Mat& paper, int border = 60) {
  cv::Mat picture;
  cv::copyMakeBorder(paper, picture, border, border, border, border, cv::BORDER_CONSTANT, 255);
  return picture;
}

/// Cells on whole pixels (2000 px/m: 7.5 px a cell is not; 3200: 12 is), and neither.
TEST(TagDrawing, TheDetectorFindsEveryTagWhereItWasDrawn) {
  const TagGridSpec spec;
  for (const double px_per_m : {3200.0, 2000.0, 1733.3}) {
    const cv::Mat paper = drawTagGrid(spec, px_per_m);
    const std::vector<Tag> tags = detectTags(framed(paper));
    ASSERT_EQ(tags.size(), 24U) << px_per_m;
    for (int id = 0; id < 24; ++id) {
      ASSERT_EQ(tags[std::size_t(id)].id, id);
      for (std::size_t i = 0; i < 4; ++i) {
        const Eigen::Vector2d seen = tags[std::size_t(id)].corners[i] - Eigen::Vector2d(60, 60);
        // The detector's own accuracy on a perfectly sharp edge, which has no slope to measure.
        EXPECT_LT((seen - onPaper(tagCorners(spec, id)[i], paper, px_per_m)).norm(), 0.3);
      }
    }
  }
}

TEST(TagDrawing, IsCrispOnWholePixelsAndHasItsWhiteMargin) {
  const cv::Mat paper = drawTagGrid({}, 1600);  // 6 px a cell, 12 px between tags
  EXPECT_EQ(paper.size(), cv::Size(372, 252));
  cv::Mat gray = (paper != 0) & (paper != 255);
  EXPECT_EQ(cv::countNonZero(gray), 0);
  EXPECT_EQ(cv::countNonZero(paper.rowRange(0, 12) != 255), 0);
  EXPECT_EQ(cv::countNonZero(paper.colRange(0, 12) != 255), 0);
  EXPECT_EQ(cv::countNonZero(paper(cv::Rect(12, 12, 48, 6))), 0);  // a tag's upper border
}

TEST(TagDrawing, GrayPixelsKeepTheInkWhereCellsAreNotWhole) {
  const auto ink = [](double px_per_m) {
    const cv::Mat paper = drawTagGrid({}, px_per_m);
    return (255 * double(paper.total()) - cv::sum(paper)[0]) / 255 / px_per_m / px_per_m;
  };
  EXPECT_NEAR(ink(1517.7) / ink(1600), 1, 1e-4);  // rounding to 8 bits, thousands of edge pixels
}

TEST(TagDrawing, RefusesResolutionsThatCannotShowATag) {
  EXPECT_THROW(drawTagGrid({}, 100), UsageError);
  EXPECT_THROW(drawTagGrid({}, 1e6), UsageError);
  EXPECT_THROW(drawTagGrid({}, std::nan("")), UsageError);
}

/// x right, y away, z up: the pose of a board seen from a known place, on every side of it.
TEST(TagGridBoard, WStandsAsItIsDefined) {
  auto camera = webcam();
  camera.distortion = {};
  const cv::Mat paper = drawTagGrid({}, 3200);
  const auto board = makeBoard("tags:6x4:0.030:0.0075", 1);
  for (int i = 0; i < 8; ++i) {
    const Pose X_CW = viewOf(0.4, rad(35), rad(45 * i), rad(10 * i));
    const auto points = board->detect(photograph(paper, 3200, X_CW, camera));
    ASSERT_EQ(points.size(), 96U);
    const auto pose = estimateBoardPose(points, camera);
    ASSERT_TRUE(pose);
    EXPECT_GT(pose->X_CW.inverse().translation().z(), 0);  // the camera is above
    EXPECT_LT((pose->X_CW.translation() - X_CW.translation()).norm(), 0.0005);
    EXPECT_LT(difference(pose->X_CW, X_CW).head<3>().norm(), rad(0.1));
    EXPECT_LT(pose->rms_px, 0.2);
  }
}

TEST(TagGridBoard, ATagSeenTwiceIsLeftOut) {
  const cv::Mat paper = framed(drawTagGrid({}, 1600));
  cv::Mat picture(paper.rows + 120, paper.cols, CV_8U, cv::Scalar(255));
  paper.copyTo(picture.rowRange(0, paper.rows));
  const cv::Rect last(60 + 12 + 5 * 60, 60 + 12, 48, 48);  // upper right: id 23
  picture(last).copyTo(picture(cv::Rect(100, paper.rows + 20, 48, 48)));
  const auto points = makeBoard(TagGridSpec{}, 1)->detect(picture);
  EXPECT_EQ(points.size(), 23U * 4);
  for (const BoardPoint& point : points)
    EXPECT_FALSE(point.p_W.x() > 0.075 && point.p_W.y() > 0.04) << "a corner of id 23 was used";
}

TEST(TagGridBoard, ForeignIdsAreIgnored) {
  const cv::Mat other = framed(drawTagGrid({6, 4, 0.03, 0.0075, 24}, 1600));
  EXPECT_TRUE(makeBoard(TagGridSpec{}, 1)->detect(other).empty());
  EXPECT_EQ(makeBoard("tags:6x4:0.03:0.0075:24", 1)->detect(other).size(), 96U);
}

TEST(TagGridBoard, SeesWhatIsNotCovered) {
  cv::Mat picture = framed(drawTagGrid({}, 1600));
  cv::rectangle(picture, {0, 0, picture.cols / 2, picture.rows}, 90, cv::FILLED);
  const auto points = makeBoard(TagGridSpec{}, 1)->detect(picture);
  EXPECT_EQ(points.size(), 12U * 4);
  for (const BoardPoint& point : points) EXPECT_GT(point.p_W.x(), 0);
}

TEST(TagGridBoard, TakesGrayAndColourAndNothingElse) {
  const cv::Mat gray = framed(drawTagGrid({}, 1600));
  cv::Mat colour, deep;
  cv::cvtColor(gray, colour, cv::COLOR_GRAY2BGR);
  gray.convertTo(deep, CV_16U);
  const auto board = makeBoard(TagGridSpec{}, 1);
  const auto a = board->detect(gray), b = board->detect(colour);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].pixel, b[i].pixel);
  EXPECT_THROW(board->detect(deep), Error);
  EXPECT_THROW(board->detect(cv::Mat()), Error);
}

/// A window into a larger picture has rows that do not follow each other in memory.
TEST(TagGridBoard, ReadsAWindowOfALargerPicture) {
  const cv::Mat gray = framed(drawTagGrid({}, 1600));
  cv::Mat larger(gray.rows + 40, gray.cols + 77, CV_8U, cv::Scalar(30));
  cv::Mat window = larger(cv::Rect(13, 20, gray.cols, gray.rows));
  gray.copyTo(window);
  EXPECT_EQ(makeBoard(TagGridSpec{}, 1)->detect(window).size(), 96U);
}

TEST(SingleTag, WIsTheLargestTag) {
  cv::Mat picture(400, 700, CV_8U, cv::Scalar(255));
  const cv::Mat small = drawTagGrid({1, 1, 0.03, 0.0075, 3}, 2000);
  const cv::Mat large = drawTagGrid({1, 1, 0.03, 0.0075, 8}, 6000);
  small.copyTo(picture(cv::Rect({40, 40}, small.size())));
  large.copyTo(picture(cv::Rect({300, 60}, large.size())));
  const auto points = makeBoard("tag36h11:0.05", 1)->detect(picture);
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[0].p_W, Vec3(-0.025, -0.025, 0));
  EXPECT_EQ(points[2].p_W, Vec3(0.025, 0.025, 0));
  EXPECT_GT(points[0].pixel.x(), 300);
  EXPECT_GT(points[0].pixel.y(), points[2].pixel.y());  // +y is up
}

}  // namespace
}  // namespace palpa::ar

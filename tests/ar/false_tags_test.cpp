#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/ar/views.h"

/// Nothing that is not ours may be claimed: a false corner would enter a registration.
namespace palpa::ar {
namespace {

int claimed(const cv::Mat& picture) {
  static const auto board = makeBoard(TagGridSpec{}, 2);
  static const auto any = makeBoard("tag36h11:0.05", 2);
  return int(board->detect(picture).size() + any->detect(picture).size()) / 4;
}

TEST(FalseTags, NoneInNoise) {
  std::mt19937 random(1);
  for (int i = 0; i < 30; ++i) {
    cv::Mat picture(480, 640, CV_8U);
    for (int j = 0; j < 640 * 480; ++j) picture.data[j] = uchar(random() >> 24);
    if (i % 3 > 0) {  // coarser grains make more outlines
      cv::Mat coarse = picture(cv::Rect(0, 0, 640 >> (1 + i % 3), 480 >> (1 + i % 3))).clone();
      cv::resize(coarse, picture, picture.size(), 0, 0,
                 i % 2 ? cv::INTER_NEAREST : cv::INTER_CUBIC);
    }
    EXPECT_EQ(claimed(picture), 0) << i;
  }
}

TEST(FalseTags, NoneInText) {
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    cv::Mat page(480, 640, CV_8U, cv::Scalar(240));
    const double scale = 0.4 + 0.1 * (i % 10);
    for (int y = 20; y < 480; y += int(30 * scale)) {
      std::string line;
      for (int k = 0; k < 80; ++k) line += char('!' + random() % 94);
      cv::putText(page, line, {5, y}, i % 8, scale, 10, 1 + i % 3, cv::LINE_AA);
    }
    EXPECT_EQ(claimed(page), 0) << i;
  }
}

TEST(FalseTags, NoneInRandomGrids) {  // the worst case: squares with white margins and random cells
  std::mt19937 random(3);
  for (int i = 0; i < 30; ++i) {
    cv::Mat small(48, 64, CV_8U, cv::Scalar(255));
    for (int y = 1; y + 8 < 48; y += 11)
      for (int x = 1; x + 8 < 64; x += 11) {
        small(cv::Rect(x, y, 8, 8)) = 0;
        for (int j = 0; j < 36; ++j)
          if (random() & 1U) small.at<uchar>(y + 1 + j / 6, x + 1 + j % 6) = 255;
      }
    cv::Mat picture;
    cv::resize(small, picture, {640, 480}, 0, 0, cv::INTER_NEAREST);
    EXPECT_EQ(claimed(picture), 0) << i;
  }
}

cv::Mat sheetOf(const std::string& family, int count) {
  cv::Mat sheet(480, 640, CV_8U, cv::Scalar(255));
  for (int i = 0; i < count; ++i)
    cv::resize(drawForeignTag(family, i),
               sheet(cv::Rect(20 + 125 * (i % 5), 15 + 120 * (i / 5), 90, 90)), {90, 90}, 0, 0,
               cv::INTER_NEAREST);
  return sheet;
}

TEST(FalseTags, NoneInOtherFamilies) {
  for (const std::string& family : foreignTagFamilies())
    EXPECT_EQ(claimed(sheetOf(family, 20)), 0) << family;
  EXPECT_THROW(drawForeignTag("tag36h11", 0), UsageError);
}

/// The same arrangement with tags of ours is seen: the silence above is no blindness.
TEST(FalseTags, ButOursAreFoundTheSameWay) {
  cv::Mat sheet(480, 640, CV_8U, cv::Scalar(255));
  for (int i = 0; i < 20; ++i) {
    const cv::Mat tag = drawTagGrid({1, 1, 0.08, 0.01, i}, 900);
    cv::resize(tag, sheet(cv::Rect(20 + 125 * (i % 5), 15 + 120 * (i / 5), 90, 90)), {90, 90});
  }
  EXPECT_EQ(claimed(sheet), 20 + 1);
}

}  // namespace
}  // namespace palpa::ar

#include "apps/task_search/floor_maps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/task_search/valley_lines.h"

/// The maps of which pictures are made.
namespace palpa::task_search {
namespace {

constexpr double kSide = 240;
constexpr int kPixels = 64;

double dent(double x, double y) { return -2 * std::exp(-(x * x + (y - 30) * (y - 30)) / 200); }

TEST(FloorMaps, HeightsAreThoseOfThePlacesThatPixelsStandFor) {
  const SquareMap map = mapOf(dent, 20, 10, 5, 30);
  ASSERT_EQ(map.values.size(), 400u);
  EXPECT_EQ(map.x, 5);
  EXPECT_FLOAT_EQ(map.values[0], static_cast<float>(dent(5 - 4.75, 30 - 4.75)));
  EXPECT_FLOAT_EQ(map.values[3 * 20 + 7], static_cast<float>(dent(5 - 1.25, 30 - 3.25)));
}

TEST(FloorMaps, TheFilterIsAntisymmetricAndAsWideAsItsPixelsAreOnTheFloor) {
  const SquareMap map = filterMap(3, 1, kPixels, kSide);
  const auto count = map.values.size();
  ASSERT_EQ(count, static_cast<std::size_t>(map.size) * static_cast<std::size_t>(map.size));
  EXPECT_NEAR(map.side, map.size * kSide / kPixels, 1e-9);
  float largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_NEAR(map.values[i], -map.values[count - 1 - i], 1e-5);
    largest = std::max(largest, map.values[i]);
  }
  EXPECT_NEAR(largest, 1, 1e-5);
}

TEST(FloorMaps, TheResponseIsWhatTheFilterMakesOfTheHeights) {
  const cv::Mat whole = filtered(heightMap(dent, kPixels, kSide), gaborKernel(5, 2));
  const SquareMap map = responseMap(dent, 5, 2, kPixels, kSide);
  ASSERT_EQ(map.values.size(), 64u * 64u);
  EXPECT_EQ(map.side, kSide);
  EXPECT_EQ(map.values[10 * 64 + 20], whole.at<float>(10, 20));
  EXPECT_EQ(map.values[40 * 64 + 3], whole.at<float>(40, 3));
}

/// So a picture may have half of the pixels and a scale less.
TEST(FloorMaps, HalfThePixelsAndAScaleLessAreTheSameFilterOnTheFloor) {
  const SquareMap fine = responseMap(dent, 3, 3, 128, kSide),
                  coarse = responseMap(dent, 3, 2, 64, kSide);
  float largest = 0, worst = 0;
  for (std::size_t j = 16; j < 48; ++j)
    for (std::size_t i = 16; i < 48; ++i) {
      float mean = 0;
      for (std::size_t k = 0; k < 4; ++k)
        mean += fine.values[(2 * j + k / 2) * 128 + 2 * i + k % 2] / 4;
      largest = std::max(largest, std::abs(mean));
      worst = std::max(worst, std::abs(mean - coarse.values[j * 64 + i]));
    }
  EXPECT_GT(largest, 0.05F);
  EXPECT_LT(worst, 0.03F * largest) << "of the pixels' width";
}

}  // namespace
}  // namespace palpa::task_search

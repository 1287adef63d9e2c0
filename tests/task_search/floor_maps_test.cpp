#include "apps/task_search/floor_maps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/error.h"
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

TEST(FloorMaps, TheResponseIsTheFiltersShownInMeans) {
  const cv::Mat whole = filtered(heightMap(dent, kPixels, kSide), gaborKernel(5, 2));
  const SquareMap all = responseMap(dent, 5, 2, kPixels, kSide, kPixels),
                  half = responseMap(dent, 5, 2, kPixels, kSide, kPixels / 2);
  ASSERT_EQ(all.values.size(), 64u * 64u);
  ASSERT_EQ(half.values.size(), 32u * 32u);
  EXPECT_EQ(half.side, kSide);
  EXPECT_FLOAT_EQ(all.values[10 * 64 + 20], whole.at<float>(10, 20));
  const float mean = (whole.at<float>(40, 20) + whole.at<float>(40, 21) + whole.at<float>(41, 20) +
                      whole.at<float>(41, 21)) /
                     4;
  EXPECT_NEAR(half.values[20 * 32 + 10], mean, 1e-6);
  EXPECT_THROW(responseMap(dent, 5, 2, kPixels, kSide, 10), Error);
}

}  // namespace
}  // namespace palpa::task_search

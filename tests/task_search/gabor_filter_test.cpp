#include "apps/task_search/valley_lines.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tests/task_search/shipped_search.h"

namespace palpa::task_search {
namespace {

using haptics::GaborTable;

/// The same in double, by OpenCV's correlation with the filter turned by half a turn: that is the
/// convolution. That it is, sums of a pixel's own confirm (below).
cv::Mat directly(const cv::Mat& map, const cv::Mat& kernel) {
  cv::Mat turned, wide, response;
  cv::flip(kernel, turned, -1);
  turned.convertTo(turned, CV_64F);
  map.convertTo(wide, CV_64F);
  const int border = kernel.rows / 2;
  cv::copyMakeBorder(wide, wide, border, border, border, border, cv::BORDER_CONSTANT,
                     cv::Scalar(0));
  cv::filter2D(wide, response, CV_64F, turned);
  return response(cv::Rect(border, border, map.cols, map.rows)).clone();
}

TEST(GaborFilter, IsAntisymmetricAndOfNormOne) {
  for (int scale = 0; scale < 3; ++scale)
    for (int d = 0; d < GaborTable::kDirections; d += 5) {
      const cv::Mat k = gaborKernel(d, scale);
      cv::Mat turned;
      cv::flip(k, turned, -1);
      EXPECT_NEAR(cv::norm(k, cv::NORM_L1), 1, 1e-5);
      EXPECT_LT(cv::norm(k + turned, cv::NORM_INF), 1e-7);
      EXPECT_NEAR(cv::sum(k)[0], 0, 1e-6);
      EXPECT_LT(cv::norm(k + gaborKernel((d + 16) % 32, scale), cv::NORM_INF),
                1e-7);  // the other way: the negative
    }
}

TEST(GaborFilter, IsPositiveWhereTheSurfaceRisesInItsDirection) {
  const double t = 2 * std::numbers::pi * 3 / 32;
  const cv::Mat ramp =
      heightMap([&](double x, double y) { return x * std::cos(t) + y * std::sin(t); }, 128, 30);
  const auto middle = [&](int d, int scale) {
    return filtered(ramp, gaborKernel(d, scale)).at<float>(64, 64);
  };
  for (int scale = 0; scale < 3; ++scale) {
    EXPECT_GT(middle(3, scale), 0);
    EXPECT_LT(middle(19, scale), 0);
    EXPECT_NEAR(middle(11, scale), 0,
                1e-3 * middle(3, scale));  // across: neither; heights of 15 U in single precision
    EXPECT_GT(middle(3, scale), middle(6, scale));
  }
}

/// By the definition, one pixel: sum of map(p - q) kernel(q), nothing beyond the border.
double summedAt(const cv::Mat& map, const cv::Mat& kernel, int i, int j) {
  const int half = kernel.rows / 2;
  double sum = 0;
  for (int v = -half; v <= half; ++v)
    for (int u = -half; u <= half; ++u) {
      const int x = i - u, y = j - v;
      if (x >= 0 && y >= 0 && x < map.cols && y < map.rows)
        sum += static_cast<double>(map.at<float>(y, x)) *
               static_cast<double>(kernel.at<float>(v + half, u + half));
    }
  return sum;
}

TEST(GaborFilter, WhatTheTableIsComparedWithIsTheSumByItsDefinition) {
  const haptics::SearchSurface surface =
      surfaceOf(shippedSearch().spec, episodeWith(assess::SearchMode::augmented));
  const cv::Mat map =
      heightMap([&](double x, double y) { return surface.smoothHeight(x, y); }, 128, 240);
  for (int scale = 0; scale < GaborTable::kScales; ++scale) {
    const cv::Mat kernel = gaborKernel(3 + 5 * scale, scale), response = directly(map, kernel);
    for (int n = 0; n < 60; ++n) {
      const int i = 37 * n % 128, j = (53 * n + 11) % 128;
      EXPECT_NEAR(response.at<double>(j, i), summedAt(map, kernel, i, j), 1e-9)
          << scale << ": " << i << ' ' << j;
    }
  }
}

TEST(GaborFilter, TheTableAgreesWithDirectConvolution) {
  const int size = std::getenv("PALPA_FULL") ? 1024 : 256;
  const SearchSettings task = shippedSearch();
  const haptics::SearchSurface surface =
      surfaceOf(task.spec, episodeWith(assess::SearchMode::augmented));
  const cv::Mat map = heightMap([&](double x, double y) { return surface.smoothHeight(x, y); },
                                size, task.spec.side);
  const GaborTable table = riseTable(map, task.spec.side, task.rise_share);
  long bits = 0, close = 0, wrong = 0, set = 0;
  const int step = size == 256 ? 1 : 4;  // directions looked at
  for (int scale = 0; scale < GaborTable::kScales; ++scale) {
    std::vector<cv::Mat> responses;
    double peak = 0;
    for (int d = 0; d < 16; ++d)
      responses.push_back(d % step == 0 || scale < 3 ? directly(map, gaborKernel(d, scale))
                                                     : filtered(map, gaborKernel(d, scale)));
    for (const cv::Mat& r : responses) peak = std::max(peak, cv::norm(r, cv::NORM_INF));
    for (int d = 0; d < 32; ++d) {
      cv::Mat r;
      responses[static_cast<std::size_t>(d % 16)].convertTo(r, CV_64F, d < 16 ? 1 : -1);
      for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i) {
          const double over = r.at<double>(j, i) - task.rise_share * peak;
          ++bits;
          set += over > 0;
          if (table.pixel(i, j, d, scale) == (over > 0)) continue;
          ++(std::abs(over) < 1e-5 * peak ? close : wrong);
        }
    }
  }
  std::printf("%ld bits compared, %ld set; %ld differ within 1e-5 of the peak, %ld elsewhere\n",
              bits, set, close, wrong);
  EXPECT_EQ(wrong, 0);
  EXPECT_LT(close, bits / 10'000);
  EXPECT_GT(set, bits / 200);
}

TEST(GaborFilter, TheTableOfTheTaskFitsInto24MB) {
  EXPECT_EQ(GaborTable(1024, 240).bytes(), 20'971'520u);
}

}  // namespace
}  // namespace palpa::task_search

#include "ar/cameras/picture_look.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "anatomy/base/error.h"

namespace palpa::ar {
namespace {

struct Lens {
  double blur_px = 1, grain = 0, grain_per_level = 0;           ///< grain: gray levels
  std::array<double, 3> paper{230, 230, 230}, ink{30, 30, 30};  ///< red, green, blue
  bool own_grain = true;                                        ///< in each channel
};

/// Dark squares on paper, turned by 7 degrees: drawn 8 times as large, blurred there, averaged.
cv::Mat3f squares(int width, int height, const Lens& lens) {
  constexpr int kFine = 8;
  cv::Mat1f ink(height * kFine, width * kFine, 0.0F);
  const double turn = 0.12;
  for (int v = 0; v < ink.rows; ++v)
    for (int u = 0; u < ink.cols; ++u) {
      const double x = (std::cos(turn) * u + std::sin(turn) * v) / kFine + 1e4,
                   y = (std::cos(turn) * v - std::sin(turn) * u) / kFine + 1e4;
      if (std::fmod(x, 60) < 30 && std::fmod(y, 60) < 30) ink(v, u) = 1;
    }
  // What averaging adds is part of the lens.
  const double extra = lens.blur_px * lens.blur_px - 1.0 / 12;
  if (extra > 0) cv::GaussianBlur(ink, ink, {0, 0}, kFine * std::sqrt(extra));
  cv::Mat1f seen;
  cv::resize(ink, seen, {width, height}, 0, 0, cv::INTER_AREA);
  cv::Mat3f picture(height, width);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      for (std::size_t k = 0; k < 3; ++k)
        picture(v, u)[static_cast<int>(2 - k)] = static_cast<float>(
            lens.paper[k] + (lens.ink[k] - lens.paper[k]) * static_cast<double>(seen(v, u)));
  return picture;
}

cv::Mat taken(const Lens& lens, unsigned int seed = 1) {
  cv::Mat3f picture = squares(480, 360, lens);
  std::mt19937 bits(seed);
  std::normal_distribution<double> normal;
  for (cv::Vec3f& pixel : picture) {
    const double common = normal(bits);
    for (int k = 0; k < 3; ++k) {
      const double noise = lens.own_grain ? normal(bits) : common;
      const double level = pixel[k];
      pixel[k] += static_cast<float>(
          noise * std::sqrt(lens.grain * lens.grain + lens.grain_per_level * level));
    }
  }
  cv::Mat bytes;
  picture.convertTo(bytes, CV_8UC3);
  return bytes;
}

class Blurs : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Lens, Blurs, testing::Values(0.5, 0.7, 1.0, 1.4, 2.0));

TEST_P(Blurs, AreFoundInGrain) {
  Lens lens;
  lens.blur_px = GetParam();
  lens.grain = 4;
  const auto look = lookOf(taken(lens));
  ASSERT_TRUE(look);
  EXPECT_NEAR(look->blur_px, GetParam(), 0.05 * GetParam());
}

class Grains : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Camera, Grains, testing::Values(1.5, 3.0, 6.0, 10.0));

TEST_P(Grains, AreFoundAtEveryBrightness) {
  Lens lens;
  lens.grain = GetParam();
  lens.paper = {200, 200, 200};
  lens.ink = {50, 50, 50};
  const auto look = lookOf(taken(lens));
  ASSERT_TRUE(look);
  EXPECT_NEAR(255 * look->grain.back(), GetParam(), 0.07 * GetParam());
  EXPECT_NEAR(255 * look->grain.front(), GetParam(), 0.07 * GetParam());
  EXPECT_NEAR(look->grain_neighbours, 0, 0.05);
  EXPECT_NEAR(look->grain_colour, 1, 0.1);
}

TEST(PictureLook, GrainThatGrowsWithTheLight) {
  Lens lens;
  lens.grain = 1;
  lens.grain_per_level = 0.2;
  lens.paper = {200, 200, 200};
  const auto look = lookOf(taken(lens));
  ASSERT_TRUE(look);
  EXPECT_NEAR(255 * look->grain.back(), std::sqrt(1 + 0.2 * 200), 0.5);
  EXPECT_NEAR(255 * look->grain.front(), std::sqrt(1 + 0.2 * 30), 0.3);
}

TEST(PictureLook, GrainAlikeInAllChannels) {
  Lens lens;
  lens.grain = 5;
  lens.own_grain = false;
  EXPECT_LT(lookOf(taken(lens))->grain_colour, 0.05);
}

TEST(PictureLook, NeighboursThatShareTheirGrain) {
  Lens lens;
  lens.grain = 8;
  cv::Mat picture = taken(lens), mixed;
  const cv::Mat half = (cv::Mat_<float>(2, 2) << 0.25F, 0.25F, 0.25F, 0.25F);
  cv::filter2D(picture, mixed, -1, half);  // of one next to the other a half is the same
  EXPECT_NEAR(lookOf(mixed)->grain_neighbours, 0.5, 0.06);
}

TEST(PictureLook, ExposureAndWhiteBalance) {
  Lens lens;
  lens.paper = {210, 180, 150};
  lens.ink = {40, 35, 30};
  lens.grain = 2;
  const auto look = lookOf(taken(lens));
  ASSERT_TRUE(look);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(255 * look->white[k], lens.paper[k], 3);
    EXPECT_NEAR(255 * look->black[k], lens.ink[k], 3);
  }
}

/// A lens is not as sharp everywhere: what counts is where the board is.
TEST(PictureLook, OfThePartThatIsAskedFor) {
  Lens lens;
  lens.blur_px = 0.8;
  lens.grain = 2;
  cv::Mat picture = taken(lens);
  lens.blur_px = 1.8;
  const cv::Rect left(0, 0, 240, 360), right(240, 0, 240, 360), sky(0, 0, 30, 30);
  taken(lens)(right).copyTo(picture(right));
  EXPECT_NEAR(lookOf(picture, left)->blur_px, 0.8, 0.06);
  EXPECT_NEAR(lookOf(picture, right)->blur_px, 1.8, 0.1);
  const auto anywhere = lookOf(picture, sky);  // too few edges there
  ASSERT_TRUE(anywhere);
  EXPECT_NEAR(anywhere->blur_px, lookOf(picture)->blur_px, 1e-12);
}

TEST(PictureLook, SaysNothingOfWhatShowsNothing) {
  EXPECT_FALSE(lookOf(cv::Mat(360, 480, CV_8UC1, cv::Scalar(120))));
  cv::Mat noise(360, 480, CV_8UC1);
  cv::randu(noise, 0, 256);
  EXPECT_FALSE(lookOf(noise));
  EXPECT_FALSE(lookOf(cv::Mat(5, 3, CV_8UC3, cv::Scalar(1, 2, 3))));
  EXPECT_THROW(lookOf(cv::Mat(360, 480, CV_16UC1, cv::Scalar(0))), Error);
  EXPECT_THROW(lookOf(cv::Mat()), Error);
}

}  // namespace
}  // namespace palpa::ar

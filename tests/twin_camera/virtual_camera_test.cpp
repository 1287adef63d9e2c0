#include "apps/twin/virtual_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "tests/twin_camera/bench_views.h"

namespace palpa::twin {
namespace {

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

cv::Mat floatDifference(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat d;
  cv::subtract(a, b, d, cv::noArray(), CV_32F);
  return d;
}

TEST(VirtualCamera, IsAFunctionOfSeedFrameAndPoseAlone) {
  const VirtualCamera camera(benchLens(), {}, {}, 7), again(benchLens(), {}, {}, 7);
  const Pose X = benchView(1, 0.5);
  const cv::Mat picture = camera.render(X, 5);
  EXPECT_EQ(picture.type(), CV_8UC1);
  EXPECT_EQ(picture.size(), cv::Size(640, 480));
  camera.render(benchView(2, 0.4), 6);  // leaves no trace
  EXPECT_TRUE(same(camera.render(X, 5), picture));
  EXPECT_TRUE(same(again.render(X, 5), picture));
  EXPECT_FALSE(same(camera.render(X, 6), picture));
  EXPECT_FALSE(same(camera.render(benchView(2, 0.5), 5), picture));
  EXPECT_FALSE(same(VirtualCamera(benchLens(), {}, {}, 8).render(X, 5), picture));
}

TEST(VirtualCamera, APartIsThatOfTheWholePicture) {
  const cv::Rect parts[] = {{100, 80, 200, 160}, {0, 0, 33, 48}, {600, 400, 40, 80},
                            {-20, 200, 90, 11},  {7, 470, 1, 1}, {0, 0, 640, 480}};
  for (const double blur : {0.0, 0.6, 2.3}) {
    VirtualCameraSettings settings;
    settings.blur_sigma_px = blur;
    const VirtualCamera camera(benchLens(), {}, settings, 7);
    const cv::Mat whole = camera.render(benchView(1, 0.5), 5);
    for (const cv::Rect& part : parts) {
      const cv::Rect inside = part & cv::Rect(0, 0, 640, 480);
      cv::Mat seen = camera.render(benchView(1, 0.5), 5, part);
      EXPECT_TRUE(same(seen(inside), whole(inside))) << part << ", blur " << blur;
      seen(inside).setTo(0);
      EXPECT_EQ(cv::countNonZero(seen), 0) << part;
    }
    EXPECT_TRUE(same(camera.render(benchView(1, 0.5), 5, {}), whole));
  }
}

TEST(VirtualCamera, NoiseHasTheStatedSizeAndIsFreshInEveryFrameAndRow) {
  const Pose X = benchView(3, 0.5);
  const VirtualCamera clean(benchLens(), {}, {0.6, 0, 0, 1}, 7);
  EXPECT_TRUE(same(clean.render(X, 1), clean.render(X, 2)));
  for (const double sigma : {3.0, 6.0}) {
    const VirtualCamera noisy(benchLens(), {}, {0.6, sigma, 0, 1}, 7);
    const cv::Mat a = floatDifference(noisy.render(X, 1), clean.render(X, 1));
    const cv::Mat b = floatDifference(noisy.render(X, 2), clean.render(X, 2));
    cv::Scalar mean, deviation;
    cv::meanStdDev(a, mean, deviation);
    // Rounding both to whole gray levels adds 2/12; 307200 samples know a deviation to 0.13 %. The
    // rounding of the clean picture is shared by all: a correlation of 1/12/sigma^2, 0.009 at most.
    EXPECT_NEAR(deviation[0], std::sqrt(sigma * sigma + 1 / 6.0), 0.006 * sigma);
    EXPECT_NEAR(mean[0], 0, 0.05);
    const double unit = double(a.total()) * sigma * sigma;
    EXPECT_NEAR(a.dot(b) / unit, 0, 0.02) << "frames repeat";
    EXPECT_NEAR(a.rowRange(1, 480).dot(a.rowRange(0, 479)) / unit, 0, 0.02) << "rows repeat";
    EXPECT_NEAR(a.colRange(1, 640).clone().dot(a.colRange(0, 639).clone()) / unit, 0, 0.02);
  }
}

TEST(VirtualCamera, ExposureScalesTheLightUntilPaperSaturates) {
  const Pose X = benchView(4, 0.5);
  const auto at = [&](double exposure) {
    return VirtualCamera(benchLens(), {}, {0.6, 0, 0, exposure}, 7).render(X, 0);
  };
  const double full = cv::mean(at(1))[0];
  EXPECT_NEAR(cv::mean(at(0.5))[0] / full, 0.5, 0.01);
  EXPECT_EQ(cv::countNonZero(at(1) == 255), 0);
  EXPECT_GT(cv::countNonZero(at(1.5) == 255), 1000);
}

TEST(VirtualCamera, BlurSoftensEdges) {
  const Pose X = lookAt({0, 0, 0}, 0.4, 0, 0, 0);
  const auto sharpness = [&](double blur) {
    cv::Mat edges;
    cv::Laplacian(VirtualCamera(benchLens(), {}, {blur, 0, 0, 1}, 7).render(X, 0), edges, CV_32F);
    return cv::norm(edges, cv::NORM_L1);
  };
  EXPECT_GT(sharpness(0), 1.2 * sharpness(0.6));
  EXPECT_GT(sharpness(0.6), 1.2 * sharpness(1.5));
}

TEST(VirtualCamera, SeesNoBoardWhereThereIsNone) {
  const VirtualCamera camera(benchLens(), {}, {}, 7);
  const auto board = ar::makeBoard(ar::TagGridSpec{});
  const Mat3 up = Mat3::Identity();
  const Mat3 down = Vec3(1, -1, -1).asDiagonal();
  EXPECT_TRUE(board->detect(camera.render(makePose(up, {0, 0, -0.5}), 0)).empty());  // looks up
  EXPECT_TRUE(board->detect(camera.render(makePose(up, {0, 0, 0.5}), 0)).empty());   // from below
  EXPECT_TRUE(board->detect(camera.render(makePose(down, {1.5, 0, 0.5}), 0)).empty());  // far aside
  EXPECT_EQ(board->detect(camera.render(makePose(down, {0, 0, 0.5}), 0)).size(), 96U);
}

TEST(VirtualCamera, AGrazingViewShowsTheTableUpToTheHorizon) {
  const VirtualCamera camera(benchLens(), {}, {0.6, 0, 0, 1}, 7);
  const cv::Mat picture = camera.render(lookAt({0, 0, 0}, 0.5, rad(80), 0, 0), 0);
  const cv::Mat sky = picture(cv::Rect(200, 0, 240, 60));
  double low = 0, high = 0;
  cv::minMaxLoc(sky, &low, &high);
  EXPECT_LT(high - low, 30);  // even but for the light
}

TEST(VirtualCamera, RefusesWhatCannotBe) {
  const auto make = [](const VirtualCameraSettings& s) { VirtualCamera(benchLens(), {}, s, 1); };
  EXPECT_THROW(make({-1, 3, 0, 1}), UsageError);
  EXPECT_THROW(make({0.6, std::nan(""), 0, 1}), UsageError);
  EXPECT_THROW(make({0.6, 3, -1, 1}), UsageError);
  EXPECT_THROW(make({0.6, 3, 0, 0}), UsageError);
  EXPECT_THROW(VirtualCamera({}, {}, {}, 1), Error);
  EXPECT_THROW(VirtualCamera(benchLens(), {0, 4, 0.03, 0.0075, 0}, {}, 1), UsageError);
}

/// Pictures decide poses, and poses what a simulated person does: the drawing may become cheaper,
/// but not another one.
TEST(TextureLookUp, IsThatOfOpenCvToTheBit) {
  constexpr int kRow = 1000;
  cv::Mat texture(61, 97, CV_8U), x(1, kRow, CV_32F), y(1, kRow, CV_32F);
  for (int v = 0; v < texture.rows; ++v)
    for (int u = 0; u < texture.cols; ++u)
      texture.at<unsigned char>(v, u) =
          static_cast<unsigned char>(picture::randomBits(1, std::uint64_t(97 * v + u)) >> 56);
  std::vector<std::int32_t> column(kRow), row(kRow);
  for (std::uint64_t round = 0; round < 20; ++round) {
    for (int u = 0; u < kRow; ++u) {
      const auto draw = [&](std::uint64_t i) {
        const double place = -40 + 180 * picture::uniform(2 + round, 2 * std::uint64_t(u) + i);
        // In even rounds halfway between two parts of a texel, where rounding has to choose.
        return float(round % 2 ? place : std::floor(64 * place) / 64);
      };
      x.at<float>(u) = draw(0);
      y.at<float>(u) = draw(1);
    }
    cv::Mat expected, found(1, kRow, CV_8U);
    cv::remap(texture, expected, x, y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    picture::castRow(Eigen::Matrix3f::Identity(), x.ptr<float>(), y.ptr<float>(), kRow,
                     column.data(), row.data());
    picture::readRow(texture, column.data(), row.data(), kRow, found.ptr<unsigned char>());
    EXPECT_TRUE(same(found, expected)) << round;
  }
}

TEST(TextureLookUp, SeesNothingBehindTheCamera) {
  Eigen::Matrix3f H = Eigen::Matrix3f::Identity();
  H(2, 2) = -1;
  const std::vector<float> x{0.5F, 0.25F}, y{0.125F, 2};
  std::vector<std::int32_t> column{7, 7}, row{7, 7};
  picture::castRow(H, x.data(), y.data(), 2, column.data(), row.data());
  EXPECT_EQ(column, std::vector<std::int32_t>(2, 0));
  EXPECT_EQ(row, std::vector<std::int32_t>(2, 0));
}

TEST(NoiseBank, IsNearlyGaussianWithTheStatedDeviation) {
  const auto bank = picture::noiseBank(3, 48, 1 << 18);
  double m2 = 0, m4 = 0, mean = 0;
  for (const std::int16_t x : bank) {
    mean += x / double(bank.size());
    m2 += double(x) * x / double(bank.size());
    m4 += double(x) * x * x * x / double(bank.size());
  }
  EXPECT_NEAR(mean, 0, 0.4);                // 48 / 512 = 0.09; four of these
  EXPECT_NEAR(std::sqrt(m2), 48, 0.3);      // 0.14 % is 0.07
  EXPECT_NEAR(m4 / (m2 * m2), 2.85, 0.05);  // sum of eight uniforms: 3 - 6 / (5 * 8)
}

TEST(RandomBits, StreamsAndCountersDoNotMeet) {
  EXPECT_EQ(picture::randomBits(1, 2), picture::randomBits(1, 2));
  EXPECT_NE(picture::randomBits(1, 2), picture::randomBits(2, 1));
  double mean = 0;
  for (std::uint64_t i = 0; i < 10000; ++i) mean += picture::uniform(5, i) / 10000;
  EXPECT_NEAR(mean, 0.5, 4 * 0.2887 / 100);
}

}  // namespace
}  // namespace palpa::twin

#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

/// Pictures beside baselines that a person has looked at, by structural similarity.
namespace palpa::test {

/// Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004) of two pictures of one size, 8-bit
/// gray, at every pixel: Gaussian window of 1.5 px.
inline cv::Mat structuralSimilarity(const cv::Mat& one, const cv::Mat& other) {
  constexpr double kC1 = 0.01 * 255 * 0.01 * 255, kC2 = 0.03 * 255 * 0.03 * 255;
  cv::Mat a, b;
  one.convertTo(a, CV_32F);
  other.convertTo(b, CV_32F);
  const auto mean = [](const cv::Mat& m) {
    cv::Mat blurred;
    cv::GaussianBlur(m, blurred, {11, 11}, 1.5);
    return blurred;
  };
  const cv::Mat ma = mean(a), mb = mean(b), aa = mean(a.mul(a)) - ma.mul(ma),
                bb = mean(b.mul(b)) - mb.mul(mb), ab = mean(a.mul(b)) - ma.mul(mb);
  cv::Mat similarity;
  cv::divide((2 * ma.mul(mb) + kC1).mul(2 * ab + kC2),
             (ma.mul(ma) + mb.mul(mb) + kC1).mul(aa + bb + kC2), similarity);
  return similarity;
}

/// Mean similarity of the tile of `side` pixels where it is least, the worst of the three colours:
/// a small thing that is gone must not drown in a large picture.
inline double leastSimilarity(const cv::Mat& one, const cv::Mat& other, int side = 50) {
  double least = 1;
  for (int channel = 0; channel < 3; ++channel) {
    cv::Mat a, b;
    cv::extractChannel(one, a, channel);
    cv::extractChannel(other, b, channel);
    const cv::Mat similarity = structuralSimilarity(a, b);
    for (int y = 0; y + side <= similarity.rows; y += side)
      for (int x = 0; x + side <= similarity.cols; x += side)
        least = std::min(least, cv::mean(similarity(cv::Rect(x, y, side, side)))[0]);
  }
  return least;
}

/// A failure leaves picture, baseline and difference in the build's folder "pictures".
/// PALPA_UPDATE_BASELINES=1 makes the baselines anew: look at each before it is kept.
inline void expectLooksLike(const cv::Mat& picture, const std::string& name,
                            double threshold = 0.97) {
  namespace fs = std::filesystem;
  const fs::path baseline = fs::path(PALPA_SOURCE_DIR) / "tests/baselines" / (name + ".png");
  if (std::getenv("PALPA_UPDATE_BASELINES")) {
    cv::imwrite(baseline.string(), picture);
    return;
  }
  const cv::Mat wanted = cv::imread(baseline.string(), cv::IMREAD_COLOR);
  ASSERT_FALSE(wanted.empty()) << "no baseline " << baseline;
  ASSERT_EQ(wanted.size(), picture.size()) << name;
  const double similarity = leastSimilarity(picture, wanted);
  EXPECT_GE(similarity, threshold) << name;
  if (similarity >= threshold) return;
  const fs::path folder = fs::path(PALPA_BUILD_DIR) / "pictures";
  fs::create_directories(folder);
  cv::Mat difference;
  cv::absdiff(picture, wanted, difference);
  cv::imwrite((folder / (name + "-picture.png")).string(), picture);
  cv::imwrite((folder / (name + "-baseline.png")).string(), wanted);
  cv::imwrite((folder / (name + "-difference.png")).string(), difference * 4);
  ADD_FAILURE() << "see " << (folder / name).string() << "-{picture,baseline,difference}.png";
}

}  // namespace palpa::test

#include "ar/cameras/picture_grain.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "anatomy/base/quantile.h"

namespace palpa::ar {
namespace {

constexpr int kBlock = 8;         // px
constexpr int kApartBlocks = 13;  // px, of blocks: those of a JPEG have nothing between them
constexpr double kCalm = 2.5;     // gray levels a pixel
constexpr int kBins = 8;          // of brightness
constexpr std::size_t kFewestBlocks = 40;

/// What one block says of the grain.
struct Block {
  double level = 0, variance = 0, neighbours = 0;  ///< neighbours: covariance with the next pixel
  double unlike = 0;                               ///< variance of red less green
};

using Residuals = Eigen::Matrix<double, kBlock, kBlock>;

/// Beside the plane that fits best.
Residuals besidePlane(Residuals block) {
  constexpr double kMiddle = 0.5 * (kBlock - 1);
  double by_u = 0, by_v = 0, squares = 0;
  for (int v = 0; v < kBlock; ++v)
    for (int u = 0; u < kBlock; ++u) {
      by_u += (u - kMiddle) * block(v, u);
      by_v += (v - kMiddle) * block(v, u);
      squares += (u - kMiddle) * (u - kMiddle);
    }
  const double mean = block.mean();
  for (int v = 0; v < kBlock; ++v)
    for (int u = 0; u < kBlock; ++u)
      block(v, u) -= mean + (by_u * (u - kMiddle) + by_v * (v - kMiddle)) / squares;
  return block;
}

double meanSquare(const Residuals& r) { return r.squaredNorm() / (kBlock * kBlock); }

/// Grain is as strong everywhere in a block, and has no shape in it: a corner or a line does.
bool isEven(const Residuals& r, double variance) {
  constexpr int kHalf = kBlock / 2;
  const double limit = 3.5 * std::sqrt(variance / (kHalf * kHalf)) + 0.25;
  for (int v = 0; v < 2; ++v)
    for (int u = 0; u < 2; ++u)
      if (std::abs(r.block<kHalf, kHalf>(v * kHalf, u * kHalf).mean()) > limit) return false;
  return r.cwiseAbs().maxCoeff() < 4.5 * std::sqrt(variance) + 1;
}

std::optional<Block> blockAt(const cv::Mat& picture, int top, int left) {
  Residuals green, red;
  for (int v = 0; v < kBlock; ++v)
    for (int u = 0; u < kBlock; ++u) {
      if (picture.channels() == 1) {
        green(v, u) = red(v, u) = picture.at<std::uint8_t>(top + v, left + u);
      } else {
        const cv::Vec3b& pixel = picture.at<cv::Vec3b>(top + v, left + u);
        green(v, u) = pixel[1];
        red(v, u) = pixel[2];
      }
    }
  const Residuals r = besidePlane(green);
  Block block{green.mean(), meanSquare(r)};
  if (!isEven(r, block.variance)) return std::nullopt;
  constexpr int kNext = kBlock - 1;
  const double right = r.leftCols<kNext>().cwiseProduct(r.rightCols<kNext>()).mean();
  const double down = r.topRows<kNext>().cwiseProduct(r.bottomRows<kNext>()).mean();
  block.neighbours = 0.5 * (right + down);
  block.unlike = meanSquare(besidePlane(red - green));
  return block;
}

/// Where a blurred picture hardly rises or falls: there no edge is near, however strong the grain.
cv::Mat1b calmPlaces(const cv::Mat& gray) {
  cv::Mat smooth, du, dv;
  gray.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {0, 0}, 2);
  cv::Sobel(smooth, du, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(smooth, dv, CV_32F, 0, 1, 3, 0.125);
  cv::Mat calm = du.mul(du) + dv.mul(dv) < kCalm * kCalm;
  return calm;
}

std::vector<Block> evenBlocks(const cv::Mat& picture, const cv::Mat& gray) {
  const cv::Mat1b calm = calmPlaces(gray);
  std::vector<Block> blocks;
  for (int top = 0; top + kBlock <= picture.rows; top += kApartBlocks)
    for (int left = 0; left + kBlock <= picture.cols; left += kApartBlocks)
      if (cv::countNonZero(calm(cv::Rect(left, top, kBlock, kBlock))) == kBlock * kBlock)
        if (const auto block = blockAt(picture, top, left)) blocks.push_back(*block);
  return blocks;
}

/// Without the highest tenth, which may have a shape in it, and the lowest.
double middleMean(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto cut = static_cast<std::ptrdiff_t>(values.size() / 10);
  const double sum = std::accumulate(values.begin() + cut, values.end() - cut, 0.0);
  return sum / static_cast<double>(values.size() - 2 * static_cast<std::size_t>(cut));
}

/// Which knot is below this level, and how far on the way to the next it is.
std::pair<std::size_t, double> knotBelow(double level) {
  const double at = std::clamp(level / 255, 0.0, 1.0) * (Grain::kKnots - 1);
  const double below = std::min(std::floor(at), Grain::kKnots - 2.0);
  return {static_cast<std::size_t>(below), at - below};
}

/// Variance over brightness, by least squares with the sum of its squared bends: means of bins,
/// each counting as often as it has blocks, to some number.
std::array<double, Grain::kKnots> varianceOver(const std::vector<Block>& blocks) {
  constexpr double kEnough = 30, kStiff = 0.3, kLevel = 0.02;
  constexpr std::size_t kFew = 8;
  std::array<std::vector<double>, kBins> level, variance;
  for (const Block& block : blocks) {
    const auto bin =
        static_cast<std::size_t>(std::clamp(block.level * kBins / 256, 0.0, kBins - 1.0));
    level[bin].push_back(block.level);
    variance[bin].push_back(block.variance);
  }
  constexpr Eigen::Index n = Grain::kKnots;
  Eigen::Matrix<double, n, n> A = Eigen::Matrix<double, n, n>::Zero();
  Eigen::Matrix<double, n, 1> y = Eigen::Matrix<double, n, 1>::Zero();
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    if (level[bin].size() < kFew) continue;
    const auto [below, part] = knotBelow(quantile(level[bin], 0.5));
    const double weight = std::min(static_cast<double>(level[bin].size()), kEnough);
    Eigen::Matrix<double, n, 1> row = Eigen::Matrix<double, n, 1>::Zero();
    row[static_cast<Eigen::Index>(below)] = 1 - part;
    row[static_cast<Eigen::Index>(below) + 1] = part;
    A += weight * row * row.transpose();
    y += weight * middleMean(variance[bin]) * row;
  }
  for (Eigen::Index k = 0; k + 1 < n; ++k) {  // straight and level where nothing is known
    A.block<2, 2>(k, k) += kLevel * Eigen::Matrix2d{{1, -1}, {-1, 1}};
    if (k + 2 >= n) continue;
    const Eigen::Vector3d bend(1, -2, 1);
    A.block<3, 3>(k, k) += kStiff * bend * bend.transpose();
  }
  const Eigen::Matrix<double, n, 1> fitted = A.ldlt().solve(y);
  std::array<double, Grain::kKnots> all;
  for (Eigen::Index k = 0; k < n; ++k) all[static_cast<std::size_t>(k)] = std::max(fitted[k], 0.0);
  return all;
}

/// A plane takes with it a part q of the variance, the more the more alike neighbours are (as each
/// pixel is a share of the next, rho, in rows and in columns):
///     q = 3 (1 + 2 rho)^2 / n,   measured covariance / measured variance = (rho - q) / (1 - q)
struct Likeness {
  double rho = 0, taken = 0;
};

Likeness likenessOf(double measured) {
  Likeness likeness;
  for (int i = 0; i < 20; ++i) {
    likeness.taken = 3 * std::pow(1 + 2 * likeness.rho, 2) / (kBlock * kBlock);
    likeness.rho = std::clamp(measured * (1 - likeness.taken) + likeness.taken, 0.0, 0.5);
  }
  return likeness;
}

double shareOf(const std::vector<Block>& blocks, double Block::*of, double times) {
  double part = 0, whole = 0;
  for (const Block& block : blocks) {
    part += block.*of;
    whole += times * block.variance;
  }
  return whole > 0 ? part / whole : 0;
}

}  // namespace

double Grain::sigmaAt(double level) const {
  const auto [below, part] = knotBelow(level);
  return std::sqrt((1 - part) * variance[below] + part * variance[below + 1]);
}

std::optional<Grain> grainOf(const cv::Mat& picture, const cv::Mat& gray) {
  const std::vector<Block> blocks = evenBlocks(picture, gray);
  if (blocks.size() < kFewestBlocks) return std::nullopt;
  Grain grain;
  grain.variance = varianceOver(blocks);
  const Likeness likeness = likenessOf(shareOf(blocks, &Block::neighbours, 1));
  for (double& variance : grain.variance) variance /= 1 - likeness.taken;
  grain.neighbours = likeness.rho;
  grain.colour = std::clamp(shareOf(blocks, &Block::unlike, 2), 0.0, 1.0);
  return grain;
}

}  // namespace palpa::ar

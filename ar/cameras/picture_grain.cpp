#include "ar/cameras/picture_grain.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "anatomy/base/quantile.h"

namespace palpa::ar {
namespace {

constexpr int kBlock = 8;      // px
constexpr double kCalm = 2.5;  // gray levels a pixel
constexpr int kBins = 8;       // of brightness
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
  for (int top = 0; top + kBlock <= picture.rows; top += 2 * kBlock)
    for (int left = 0; left + kBlock <= picture.cols; left += 2 * kBlock)
      if (cv::countNonZero(calm(cv::Rect(left, top, kBlock, kBlock))) == kBlock * kBlock)
        if (const auto block = blockAt(picture, top, left)) blocks.push_back(*block);
  return blocks;
}

/// Variance as a line over brightness: medians of bins, each counting as often as it has blocks.
Grain grainLine(const std::vector<Block>& blocks) {
  std::array<std::vector<double>, kBins> level, variance;
  for (const Block& block : blocks) {
    const auto bin =
        static_cast<std::size_t>(std::clamp(block.level * kBins / 256, 0.0, kBins - 1.0));
    level[bin].push_back(block.level);
    variance[bin].push_back(block.variance);
  }
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    if (level[bin].size() < 8) continue;
    const double weight = static_cast<double>(level[bin].size());
    const double at = quantile(level[bin], 0.5), is = quantile(variance[bin], 0.5);
    n += weight;
    x += weight * at;
    y += weight * is;
    xx += weight * at * at;
    xy += weight * at * is;
  }
  if (n == 0) return {};
  const double spread = n * xx - x * x;
  const double slope = spread > 100 * n * n ? (n * xy - x * y) / spread : 0;
  return {(y - slope * x) / n, slope};
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
  return std::sqrt(std::max(at_zero + slope * level, 0.0));
}

std::optional<Grain> grainOf(const cv::Mat& picture, const cv::Mat& gray) {
  const std::vector<Block> blocks = evenBlocks(picture, gray);
  if (blocks.size() < kFewestBlocks) return std::nullopt;
  Grain grain = grainLine(blocks);
  const Likeness likeness = likenessOf(shareOf(blocks, &Block::neighbours, 1));
  grain.at_zero /= 1 - likeness.taken;
  grain.slope /= 1 - likeness.taken;
  grain.neighbours = likeness.rho;
  grain.colour = std::clamp(shareOf(blocks, &Block::unlike, 2), 0.0, 1.0);
  return grain;
}

}  // namespace palpa::ar

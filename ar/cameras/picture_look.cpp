#include "ar/cameras/picture_look.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"

namespace palpa::ar {
namespace {

constexpr int kReach = 6;  // px on either side of an edge
constexpr int kWidth = 3;  // px along it, on either side
constexpr int kCell = 16;  // px: one edge at most in each square of the picture
constexpr std::size_t kFewestEdges = 12, kFewestBlocks = 40;
constexpr double kLeastStep = 40;  // of 255
constexpr double kStrong = 0.6;    // of nearly the highest step: black print on white
constexpr int kBlock = 8;          // px
constexpr double kCalm = 2.5;      // gray levels a pixel
constexpr int kBins = 8;           // of brightness

struct Start {
  int u = 0, v = 0;
  Eigen::Vector2d normal;  ///< toward the brighter side
};

struct Slopes {
  cv::Mat_<short> by_u, by_v;
  Eigen::Vector2d at(int u, int v) const { return {by_u(v, u), by_v(v, u)}; }
  /// Steeper than what is before and after it, the way it rises.
  bool isCrest(int u, int v) const {
    const Eigen::Vector2d here = at(u, v), step = here / here.cwiseAbs().maxCoeff();
    const int du = static_cast<int>(std::lround(step.x())),
              dv = static_cast<int>(std::lround(step.y()));
    const double squared = here.squaredNorm();
    return squared >= at(u + du, v + dv).squaredNorm() &&
           squared > at(u - du, v - dv).squaredNorm();
  }
};

/// The place on a steep crest that is nearest to a cell's middle. Not the steepest: that would be
/// where the picture is sharpest, of two directions the sharper one.
std::optional<Start> crestIn(const Slopes& slopes, const cv::Rect& cell) {
  std::optional<Start> nearest;
  double least = kCell * kCell;
  for (int v = cell.y; v < cell.y + kCell; ++v)
    for (int u = cell.x; u < cell.x + kCell; ++u) {
      const Eigen::Vector2d slope = slopes.at(u, v);
      if (slope.norm() < 2 * kLeastStep) continue;
      const double away =
          std::pow(u - cell.x - 0.5 * kCell, 2) + std::pow(v - cell.y - 0.5 * kCell, 2);
      if (away >= least || !slopes.isCrest(u, v)) continue;
      least = away;
      nearest = Start{u, v, slope.normalized()};
    }
  return nearest;
}

std::vector<Start> crestsOf(const cv::Mat& gray, const cv::Rect& where) {
  Slopes slopes;
  cv::Sobel(gray, slopes.by_u, CV_16S, 1, 0);
  cv::Sobel(gray, slopes.by_v, CV_16S, 0, 1);
  std::vector<Start> starts;
  constexpr int kMargin = kReach + kWidth + 1;
  const cv::Rect inside =
      where & cv::Rect(kMargin, kMargin, gray.cols - 2 * kMargin, gray.rows - 2 * kMargin);
  for (int top = inside.y; top + kCell <= inside.y + inside.height; top += kCell)
    for (int left = inside.x; left + kCell <= inside.x + inside.width; left += kCell)
      if (const auto start = crestIn(slopes, {left, top, kCell, kCell})) starts.push_back(*start);
  return starts;
}

struct Sample {
  double across = 0, along = 0, level = 0;
};

std::vector<Sample> samplesAround(const cv::Mat& gray, const Start& start) {
  const Eigen::Vector2d tangent(-start.normal.y(), start.normal.x());
  std::vector<Sample> samples;
  const int reach = kReach + kWidth;
  for (int v = -reach; v <= reach; ++v)
    for (int u = -reach; u <= reach; ++u) {
      const Eigen::Vector2d at(u, v);
      const double across = at.dot(start.normal), along = at.dot(tangent);
      if (std::abs(across) > kReach || std::abs(along) > kWidth) continue;
      samples.push_back(
          {across, along, static_cast<double>(gray.at<std::uint8_t>(start.v + v, start.u + u))});
    }
  return samples;
}

struct Edge {
  double low = 0, step = 0, middle = 0, turn = 0, sigma = 1;
};

/// One step of Gauss and Newton; the root of the mean square of what does not fit.
double improve(const std::vector<Sample>& samples, Edge* edge) {
  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 5, 1> right = Eigen::Matrix<double, 5, 1>::Zero();
  double squares = 0;
  for (const Sample& s : samples) {
    const double z = (s.across + edge->turn * s.along - edge->middle) / edge->sigma;
    const double phi = 0.5 * std::erfc(-z / std::numbers::sqrt2);
    const double slope =
        edge->step * std::exp(-0.5 * z * z) / (std::sqrt(2 * std::numbers::pi) * edge->sigma);
    const double left = s.level - edge->low - edge->step * phi;
    Eigen::Matrix<double, 5, 1> by;
    by << 1, phi, -slope, slope * s.along, -slope * z;
    normal += by * by.transpose();
    right += by * left;
    squares += left * left;
  }
  normal.diagonal() *= 1.001;
  const Eigen::Matrix<double, 5, 1> change = normal.ldlt().solve(right);
  edge->low += change[0];
  edge->step += change[1];
  edge->middle += change[2];
  edge->turn += change[3];
  edge->sigma = std::clamp(edge->sigma + change[4], 0.5 * edge->sigma, 2 * edge->sigma);
  return std::sqrt(squares / static_cast<double>(samples.size()));
}

/// Nothing where two flat sides and a straight edge between them do not tell what is there.
std::optional<Edge> edgeAt(const cv::Mat& gray, const Start& start) {
  const std::vector<Sample> samples = samplesAround(gray, start);
  const auto [low, high] =
      std::minmax_element(samples.begin(), samples.end(),
                          [](const Sample& a, const Sample& b) { return a.level < b.level; });
  Edge edge{low->level, high->level - low->level};
  double misfit = 0;
  for (int i = 0; i < 12; ++i) misfit = improve(samples, &edge);
  const bool inside = std::abs(edge.middle) < 2 && std::abs(edge.turn) < 0.3;
  const bool believable = edge.sigma > 0.2 && edge.sigma < 0.4 * kReach && edge.step > kLeastStep;
  if (!std::isfinite(misfit) || !inside || !believable || misfit > 0.08 * edge.step)
    return std::nullopt;
  return edge;
}

/// The mean colour at this distance from an edge, red, green, blue, of 255.
std::array<double, 3> colourBeside(const cv::Mat& picture, const Start& start, double across) {
  std::array<double, 3> sum{};
  constexpr int kAlong = 1;
  for (int along = -kAlong; along <= kAlong; ++along) {
    const int u = start.u + static_cast<int>(
                                std::lround(across * start.normal.x() - along * start.normal.y()));
    const int v = start.v + static_cast<int>(
                                std::lround(across * start.normal.y() + along * start.normal.x()));
    for (int k = 0; k < 3; ++k)
      sum[static_cast<std::size_t>(k)] += picture.channels() == 1
                                              ? picture.at<std::uint8_t>(v, u)
                                              : picture.at<cv::Vec3b>(v, u)[2 - k];
  }
  for (double& s : sum) s /= 2 * kAlong + 1;
  return sum;
}

struct Edges {
  std::vector<double> sigma, step;
  std::array<std::vector<double>, 3> bright, dark;
};

Edges edgesOf(const cv::Mat& picture, const cv::Mat& gray, const cv::Rect& where) {
  Edges edges;
  for (const Start& start : crestsOf(gray, where)) {
    const std::optional<Edge> edge = edgeAt(gray, start);
    if (!edge) continue;
    edges.sigma.push_back(edge->sigma);
    edges.step.push_back(edge->step);
    const double away = std::min(3 * edge->sigma, static_cast<double>(kReach));
    const auto bright = colourBeside(picture, start, away),
               dark = colourBeside(picture, start, -away);
    for (std::size_t k = 0; k < 3; ++k) {
      edges.bright[k].push_back(bright[k]);
      edges.dark[k].push_back(dark[k]);
    }
  }
  return edges;
}

double blurOf(const Edges& edges) {
  const double limit = kStrong * quantile(edges.step, 0.9);
  std::vector<double> strong;
  for (std::size_t i = 0; i < edges.sigma.size(); ++i)
    if (edges.step[i] >= limit) strong.push_back(edges.sigma[i]);
  return quantile(strong, 0.5);
}

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
struct GrainLine {
  double at_zero = 0, slope = 0;
  double sigmaAt(double level) const { return std::sqrt(std::max(at_zero + slope * level, 0.0)); }
};

GrainLine grainLine(const std::vector<Block>& blocks) {
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

std::optional<PictureLook> lookOf(const cv::Mat& picture, const cv::Rect& where) {
  if (picture.empty() || (picture.type() != CV_8UC1 && picture.type() != CV_8UC3))
    throw Error("the picture is neither 8-bit gray nor BGR", "the camera's look",
                "Convert the picture first");
  cv::Mat gray = picture;
  if (picture.channels() == 3) cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
  const cv::Rect all(0, 0, picture.cols, picture.rows);
  Edges edges = edgesOf(picture, gray, where.empty() ? all : where);
  if (edges.sigma.size() < kFewestEdges && !where.empty()) edges = edgesOf(picture, gray, all);
  const std::vector<Block> blocks = evenBlocks(picture, gray);
  if (edges.sigma.size() < kFewestEdges || blocks.size() < kFewestBlocks) return std::nullopt;
  PictureLook look;
  look.blur_px = blurOf(edges);
  double bright = 0, dark = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double white = quantile(edges.bright[k], 0.75), black = quantile(edges.dark[k], 0.25);
    look.white[k] = white / 255;
    look.black[k] = black / 255;
    bright += white / 3;
    dark += black / 3;
  }
  const GrainLine grain = grainLine(blocks);
  const Likeness likeness = likenessOf(shareOf(blocks, &Block::neighbours, 1));
  const double whole = 255 * std::sqrt(1 - likeness.taken);
  look.grain_white = grain.sigmaAt(bright) / whole;
  look.grain_black = grain.sigmaAt(dark) / whole;
  look.grain_neighbours = likeness.rho;
  look.grain_colour = std::clamp(shareOf(blocks, &Block::unlike, 2), 0.0, 1.0);
  return look;
}

}  // namespace palpa::ar

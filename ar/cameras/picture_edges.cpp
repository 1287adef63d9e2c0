#include "ar/cameras/picture_edges.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "anatomy/base/quantile.h"

namespace palpa::ar {
namespace {

constexpr int kReach = 6;          // px on either side of an edge
constexpr int kWidth = 3;          // px along it, on either side
constexpr int kCell = 16;          // px: one edge at most in each square of the picture
constexpr double kLeastStep = 40;  // of 255
constexpr double kStrong = 0.6;    // of nearly the highest step: black print on white

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

}  // namespace

ClearEdges clearEdges(const cv::Mat& picture, const cv::Mat& gray, const cv::Rect& where) {
  ClearEdges edges;
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

double ClearEdges::blur_px() const {
  const double limit = kStrong * quantile(step, 0.9);
  std::vector<double> strong;
  for (std::size_t i = 0; i < sigma.size(); ++i)
    if (step[i] >= limit) strong.push_back(sigma[i]);
  return quantile(strong, 0.5);
}

}  // namespace palpa::ar

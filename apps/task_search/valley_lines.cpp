#include "apps/task_search/valley_lines.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <future>
#include <numbers>
#include <optional>
#include <unordered_set>

#include "anatomy/base/pinned_math.h"
#include "anatomy/geometry/dense_solvers.h"

namespace palpa::task_search {
namespace {

using haptics::GaborTable;
constexpr int kHalfTurn = GaborTable::kDirections / 2;
constexpr double kGamma = 0.5, kCutoff = 4;

/// A map's transform, padded so that what is beyond a border does not come in at the other.
class PaddedMap {
 public:
  PaddedMap(const cv::Mat& map, int border) : size_(map.size()) {
    const cv::Size padded(cv::getOptimalDFTSize(map.cols + border),
                          cv::getOptimalDFTSize(map.rows + border));
    cv::Mat room = cv::Mat::zeros(padded, CV_32F);
    map.copyTo(room(cv::Rect(cv::Point(0, 0), map.size())));
    cv::dft(room, transform_, 0, map.rows);
  }
  cv::Mat convolvedWith(const cv::Mat& kernel) const {
    cv::Mat room = cv::Mat::zeros(transform_.size(), CV_32F), product;
    kernel.copyTo(room(cv::Rect(cv::Point(0, 0), kernel.size())));
    cv::dft(room, room, 0, kernel.rows);
    cv::mulSpectrums(transform_, room, product, 0);
    cv::dft(product, product, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
    return product(cv::Rect(cv::Point(kernel.cols / 2, kernel.rows / 2), size_)).clone();
  }

 private:
  cv::Size size_;
  cv::Mat transform_;
};

/// Responses of one scale, of the first half turn.
using HalfTurn = std::array<cv::Mat, kHalfTurn>;

HalfTurn responsesOf(const PaddedMap& map, int scale) {
  HalfTurn responses;
  const auto some = [&](int first) {
    for (int d = first; d < kHalfTurn; d += 2)
      responses[static_cast<std::size_t>(d)] = map.convolvedWith(gaborKernel(d, scale));
  };
  auto other = std::async(std::launch::async, some, 1);  // two cores: every other one each
  some(0);
  other.get();
  return responses;
}

double largestOf(const HalfTurn& responses) {
  double largest = 0;
  for (const cv::Mat& response : responses)
    largest = std::max(largest, cv::norm(response, cv::NORM_INF));
  return largest;
}

void setBits(const cv::Mat& response, int direction, int scale, double threshold,
             GaborTable* table) {
  for (int j = 0; j < response.rows; ++j) {
    const float* row = response.ptr<float>(j);
    for (int i = 0; i < response.cols; ++i) {
      const double r = static_cast<double>(row[i]);
      if (r > threshold) table->set(i, j, direction, scale, true);
      if (-r > threshold) table->set(i, j, direction + kHalfTurn, scale, true);
    }
  }
}

}  // namespace

cv::Mat gaborKernel(int direction, int scale) {
  const double sigma = std::ldexp(1.0, scale), lambda = 4 * sigma,
               t = 2 * std::numbers::pi * direction / GaborTable::kDirections, c = pinned::cos(t),
               s = pinned::sin(t);
  const int half = static_cast<int>(std::ceil(kCutoff * sigma / kGamma));
  cv::Mat kernel(2 * half + 1, 2 * half + 1, CV_64F);
  double sum = 0;
  for (int j = -half; j <= half; ++j)
    for (int i = -half; i <= half; ++i) {
      const double x = i * c + j * s, y = -i * s + j * c;
      const double value = pinned::exp(-(x * x + kGamma * kGamma * y * y) / (2 * sigma * sigma)) *
                           pinned::cos(2 * std::numbers::pi * x / lambda + std::numbers::pi / 2);
      kernel.at<double>(j + half, i + half) = value;
      sum += std::abs(value);
    }
  cv::Mat normalised(kernel.size(), CV_32F);  // by hand: OpenCV sums in the processor's order
  for (int j = 0; j < kernel.rows; ++j)
    for (int i = 0; i < kernel.cols; ++i)
      normalised.at<float>(j, i) = static_cast<float>(kernel.at<double>(j, i) / sum);
  return normalised;
}

cv::Mat heightMap(const HeightField& height, int size, double side) {
  cv::Mat map(size, size, CV_32F);
  const auto place = [&](int i) { return (i + 0.5) * side / size - side / 2; };
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i)
      map.at<float>(j, i) = static_cast<float>(height(place(i), place(j)));
  return map;
}

cv::Mat filtered(const cv::Mat& map, const cv::Mat& kernel) {
  return PaddedMap(map, kernel.rows - 1).convolvedWith(kernel);
}

haptics::GaborTable riseTable(const cv::Mat& map, double side, double share) {
  GaborTable table(map.cols, side);
  for (int scale = 0; scale < GaborTable::kScales; ++scale) {
    const HalfTurn responses = responsesOf(PaddedMap(map, gaborKernel(0, scale).rows - 1), scale);
    const double threshold = share * largestOf(responses);
    for (int d = 0; d < kHalfTurn; ++d)
      setBits(responses[static_cast<std::size_t>(d)], d, scale, threshold, &table);
  }
  return table;
}

namespace {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;
constexpr double kAlike = 0.5;       // lesser over larger curvature: from here on a pit
constexpr double kFarthestSeed = 3;  // U: a seed belongs to no valley farther away
constexpr int kMostSteps = 12;

struct Bend {
  Vec2 g;
  double k = 0, other = 0;  // curvatures, the larger first
  Vec2 e;                   // along the larger
};

Bend bendAt(const HeightField& h, const Vec2& p, double d) {
  const double x = p.x(), y = p.y(), c = h(x, y), l = h(x - d, y), r = h(x + d, y), b = h(x, y - d),
               t = h(x, y + d);
  const double xy =
      (h(x + d, y + d) - h(x + d, y - d) - h(x - d, y + d) + h(x - d, y - d)) / (4 * d * d);
  Mat2 H;
  H << (l - 2 * c + r) / (d * d), xy, xy, (b - 2 * c + t) / (d * d);
  const SymmetricEigen<2> bend = symmetricEigen(H);
  return {Vec2((r - l) / (2 * d), (t - b) / (2 * d)), bend.values[1], bend.values[0],
          bend.vectors.col(1)};
}

std::optional<haptics::ValleyPoint> valleyFrom(const HeightField& h, const Vec2& seed,
                                               const ValleySearch& search) {
  Vec2 p = seed;
  for (int i = 0; i < kMostSteps; ++i) {
    const Bend b = bendAt(h, p, search.step);
    if (b.k < 1 / search.widest) return std::nullopt;
    const bool pit = b.other > kAlike * b.k;
    const Vec2 way = pit ? Vec2(-b.g / b.k) : Vec2(-b.g.dot(b.e) / b.k * b.e);
    p += way;
    if ((p - seed).norm() > kFarthestSeed) return std::nullopt;
    if (way.norm() > 1e-7) continue;
    haptics::ValleyPoint point{p.x(), p.y(), 0, 0, 1 / b.k};
    if (!pit) point.tx = -b.e.y(), point.ty = b.e.x();
    return point;
  }
  return std::nullopt;
}

std::int64_t keyOf(double x, double y, double width) {
  constexpr std::int64_t kRow = 1 << 20;
  return std::llround(x / width) * kRow + std::llround(y / width);
}

}  // namespace

std::vector<haptics::ValleyPoint> valleyPoints(const HeightField& height,
                                               const ValleySearch& search) {
  std::vector<haptics::ValleyPoint> points;
  std::unordered_set<std::int64_t> taken;  // only asked, never walked through
  const int count = static_cast<int>(search.side / search.seeds);
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      const Vec2 seed((i + 0.5) * search.seeds - search.side / 2,
                      (j + 0.5) * search.seeds - search.side / 2);
      const auto point = valleyFrom(height, seed, search);
      if (point && taken.insert(keyOf(point->x, point->y, search.apart)).second)
        points.push_back(*point);
    }
  return points;
}

}  // namespace palpa::task_search

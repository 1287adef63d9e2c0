#include "apps/task_search/gabor_filter.h"

#include <array>
#include <cmath>
#include <future>
#include <numbers>

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
  const double sigma = std::exp2(scale), lambda = 4 * sigma,
               t = 2 * std::numbers::pi * direction / GaborTable::kDirections;
  const int half = static_cast<int>(std::ceil(kCutoff * sigma / kGamma));
  cv::Mat kernel(2 * half + 1, 2 * half + 1, CV_64F);
  for (int j = -half; j <= half; ++j)
    for (int i = -half; i <= half; ++i) {
      const double x = i * std::cos(t) + j * std::sin(t), y = -i * std::sin(t) + j * std::cos(t);
      kernel.at<double>(j + half, i + half) =
          std::exp(-(x * x + kGamma * kGamma * y * y) / (2 * sigma * sigma)) *
          std::cos(2 * std::numbers::pi * x / lambda + std::numbers::pi / 2);
    }
  cv::Mat normalised;
  kernel.convertTo(normalised, CV_32F, 1 / cv::norm(kernel, cv::NORM_L1));
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

}  // namespace palpa::task_search

#include "apps/task_search/floor_maps.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "apps/task_search/valley_lines.h"

namespace palpa::task_search {
namespace {

std::vector<float> valuesOf(const cv::Mat& map) {
  std::vector<float> values;
  values.reserve(map.total());
  for (int j = 0; j < map.rows; ++j) {
    const float* row = map.ptr<float>(j);
    values.insert(values.end(), row, row + map.cols);
  }
  return values;
}

/// Means of squares of `each` pixels a side.
std::vector<float> thinnedBy(const cv::Mat& map, int each) {
  std::vector<float> values;
  for (int j = 0; j + each <= map.rows; j += each)
    for (int i = 0; i + each <= map.cols; i += each) {
      double sum = 0;
      for (int dj = 0; dj < each; ++dj)
        for (int di = 0; di < each; ++di) sum += static_cast<double>(map.at<float>(j + dj, i + di));
      values.push_back(static_cast<float>(sum / (each * each)));
    }
  return values;
}

}  // namespace

SquareMap mapOf(const FloorHeights& height, int size, double side, double x, double y) {
  const auto moved = [&](double u, double v) { return height(x + u, y + v); };
  return {size, side, x, y, valuesOf(heightMap(moved, size, side))};
}

SquareMap filterMap(int direction, int scale, int map_px, double side) {
  const cv::Mat kernel = gaborKernel(direction, scale);
  std::vector<float> values = valuesOf(kernel);
  float largest = 0;
  for (const float value : values) largest = std::max(largest, std::abs(value));
  for (float& value : values) value /= largest;
  return {kernel.cols, kernel.cols * side / map_px, 0, 0, values};
}

SquareMap responseMap(const FloorHeights& height, int direction, int scale, int map_px, double side,
                      int shown) {
  if (shown < 1 || map_px % shown != 0)
    throw Error("is no divisor of " + std::to_string(map_px), "pixels of a response",
                "Show half or a quarter of them");
  const cv::Mat response = filtered(heightMap(height, map_px, side), gaborKernel(direction, scale));
  return {shown, side, 0, 0, thinnedBy(response, map_px / shown)};
}

}  // namespace palpa::task_search

#include "apps/task_search/floor_maps.h"

#include <algorithm>
#include <cmath>

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

SquareMap responseMap(const FloorHeights& height, int direction, int scale, int map_px,
                      double side) {
  const cv::Mat map = heightMap(height, map_px, side);
  return {map_px, side, 0, 0, valuesOf(filtered(map, gaborKernel(direction, scale)))};
}

}  // namespace palpa::task_search

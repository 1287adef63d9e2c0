#pragma once

#include <functional>
#include <vector>

namespace palpa::task_search {

/// A quantity over a square of a floor, for pictures: rows from the smallest y on, in each from the
/// smallest x; a value stands for its pixel's middle. Lengths in U, in F.
struct SquareMap {
  int size = 0;               ///< pixels a side
  double side = 0;            ///< U
  double x = 0, y = 0;        ///< its middle
  std::vector<float> values;  ///< size x size
};

/// Height at (x, y), both in U.
using FloorHeights = std::function<double(double x, double y)>;

SquareMap mapOf(const FloorHeights& height, int size, double side, double x = 0, double y = 0);

/// The filter of a direction and a scale (`gaborKernel`) on a height map of `map_px` over `side`.
/// Values of its largest one: -1 to 1.
SquareMap filterMap(int direction, int scale, int map_px, double side);

/// What that filter makes of a height field, U: `filtered` on a map of `map_px` a side.
SquareMap responseMap(const FloorHeights& height, int direction, int scale, int map_px,
                      double side);

}  // namespace palpa::task_search

#include "apps/report/polyline.h"

#include <algorithm>
#include <cmath>

#include "apps/report/numbers.h"

namespace palpa::report {
namespace {

/// One column's first, lowest, highest and last points, in the order in which they came.
void appendColumn(std::vector<Point>& line, const std::vector<Point>& column) {
  if (column.empty()) return;
  const auto [low, high] = std::minmax_element(
      column.begin(), column.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
  std::vector<std::ptrdiff_t> keep{0, low - column.begin(), high - column.begin(),
                                   static_cast<std::ptrdiff_t>(column.size()) - 1};
  std::sort(keep.begin(), keep.end());
  keep.erase(std::unique(keep.begin(), keep.end()), keep.end());
  for (const std::ptrdiff_t i : keep) line.push_back(column[static_cast<std::size_t>(i)]);
}

std::string stroke(const std::vector<Point>& line, const Axis& x, const Axis& y, char first) {
  std::string d;
  for (const Point& p : line) {
    d += d.empty() ? first : 'L';
    d += coordinate(x.at(p.x)) + ' ' + coordinate(y.at(p.y));
  }
  return d;
}

}  // namespace

std::vector<std::vector<Point>> decimated(const std::vector<Point>& points, const Axis& x,
                                          double column_px) {
  std::vector<std::vector<Point>> lines;
  std::vector<Point> line, column;
  double current = 0;
  const auto endLine = [&] {
    appendColumn(line, column);
    column.clear();
    if (!line.empty()) lines.push_back(std::move(line));
    line.clear();
  };
  for (const Point& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      endLine();
      continue;
    }
    const double index = std::floor(x.at(p.x) / column_px);
    if (!column.empty() && index != current) {
      appendColumn(line, column);
      column.clear();
    }
    current = index;
    column.push_back(p);
  }
  endLine();
  return lines;
}

std::string linePath(const std::vector<Point>& points, const Axis& x, const Axis& y) {
  std::string d;
  for (const auto& line : decimated(points, x)) d += stroke(line, x, y, 'M');
  return d;
}

std::string areaPath(const std::vector<Point>& points, const Axis& x, const Axis& y, double base) {
  std::string d;
  for (const auto& line : decimated(points, x)) {
    const Point start{line.front().x, base}, end{line.back().x, base};
    d += stroke({start}, x, y, 'M') + stroke(line, x, y, 'L') + stroke({end}, x, y, 'L') + 'Z';
  }
  return d;
}

}  // namespace palpa::report

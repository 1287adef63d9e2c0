#include "anatomy/volume/scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace palpa::anatomy {
namespace {

constexpr double kPointStep = 2e-3, kAxisSmoothing = 10e-3;
constexpr float kNever = std::numeric_limits<float>::infinity();

struct Ways {
  Values way;
  std::vector<std::size_t> before;
  std::size_t farthest = 0;
};

Ways waysFrom(const VoxelGrid& grid, const Values& cost, std::size_t from, std::size_t to) {
  Ways ways{Values(cost.size(), kNever), std::vector<std::size_t>(cost.size(), from), from};
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  ways.way[from] = 0;
  queue.emplace(0.f, from);
  while (!queue.empty()) {
    const auto [so_far, at] = queue.top();
    queue.pop();
    if (so_far > ways.way[at]) continue;
    ways.farthest = at;
    if (at == to) break;
    const Index3 c = grid.cell(at);
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const Index3 next{c[0] + x, c[1] + y, c[2] + z};
          if (!grid.holds(next)) continue;
          const std::size_t n = grid.index(next);
          if (cost[n] == kNever) continue;
          const double step = Vec3(x, y, z).cwiseProduct(grid.spacing).norm();
          const auto there = static_cast<float>(
              so_far + step * 0.5 * (cost[n] + (cost[at] == kNever ? cost[n] : cost[at])));
          if (there >= ways.way[n]) continue;
          ways.way[n] = there;
          ways.before[n] = at;
          queue.emplace(there, n);
        }
  }
  return ways;
}

}  // namespace

std::vector<std::size_t> cheapestPath(const VoxelGrid& grid, const Values& cost, std::size_t from,
                                      std::size_t to) {
  const Ways ways = waysFrom(grid, cost, from, to);
  if (ways.way[to] == kNever) return {};
  std::vector<std::size_t> path{to};
  while (path.back() != from) path.push_back(ways.before[path.back()]);
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<Vec3> smoothLine(const std::vector<Vec3>& points, double reach) {
  if (points.size() < 3) return points;
  std::vector<double> s(points.size(), 0);
  for (std::size_t i = 1; i < points.size(); ++i)
    s[i] = s[i - 1] + (points[i] - points[i - 1]).norm();
  const int count = std::max(2, static_cast<int>(s.back() / kPointStep));
  std::vector<Vec3> out;
  for (int i = 0; i <= count; ++i) {
    const double at = s.back() * i / count,
                 half = std::min({reach, at, s.back() - at});  // even about each point: ends stay
    Vec3 sum = Vec3::Zero();
    double weight = 0;
    for (std::size_t n = 0; n < points.size(); ++n) {
      const double off = std::abs(s[n] - at);
      const double w = std::max(0.0, 1 - off / (half + 2e-3));
      sum += w * points[n], weight += w;
    }
    out.push_back(weight > 0 ? Vec3(sum / weight)
                             : points[std::min(points.size() - 1, static_cast<std::size_t>(i))]);
  }
  return out;
}

std::vector<Vec3> centreLine(const Scan& scan, const Mask& mask) {
  const Values depth = distanceTo(scan.grid, inverted(mask));
  Values even(mask.size()), central(mask.size());
  std::size_t some = 0;
  for (std::size_t n = 0; n < mask.size(); ++n) {
    even[n] = mask[n] ? 1.f : kNever;
    central[n] = mask[n] ? static_cast<float>(1 + 30 * std::exp(-depth[n] / 1.5e-3)) : kNever;
    if (mask[n]) some = n;
  }
  const std::size_t one = waysFrom(scan.grid, even, some, mask.size()).farthest;
  const std::size_t other = waysFrom(scan.grid, even, one, mask.size()).farthest;
  std::vector<Vec3> points;
  for (const std::size_t n : cheapestPath(scan.grid, central, one, other))
    points.push_back(scan.place(n));
  return smoothLine(points, kAxisSmoothing);
}

}  // namespace palpa::anatomy

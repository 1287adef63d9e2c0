#include "apps/task_search/valley_lines.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_set>

namespace palpa::task_search {
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
  const Eigen::SelfAdjointEigenSolver<Mat2> solver(H);
  return {Vec2((r - l) / (2 * d), (t - b) / (2 * d)), solver.eigenvalues()[1],
          solver.eigenvalues()[0], solver.eigenvectors().col(1)};
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

#include "apps/twin/phantom/block_mesh.h"

#include <algorithm>
#include <cmath>

namespace palpa::twin {
namespace {

/// Planes from `from` to `to`, about as far apart as wanted there.
template <class Spacing>
std::vector<double> planes(double from, double to, Spacing wanted) {
  constexpr int kSteps = 4000;
  std::vector<double> elements(kSteps + 1, 0.0);  // how many there are up to here
  const double step = (to - from) / kSteps;
  for (int i = 0; i < kSteps; ++i)
    elements[i + 1] = elements[i] + step / wanted(from + (i + 0.5) * step);
  const int count = std::max(2, static_cast<int>(std::lround(elements.back())));
  std::vector<double> at(count + 1, from);
  for (int k = 1, i = 0; k < count; ++k) {
    const double target = elements.back() * k / count;
    while (elements[i + 1] < target) ++i;
    at[k] = from + step * (i + (target - elements[i]) / (elements[i + 1] - elements[i]));
  }
  at[count] = to;
  return at;
}

double spacing(const Fineness& fineness, double away) {
  return std::min(fineness.coarsest, fineness.finest + fineness.growth * std::max(0.0, away));
}

/// A lump is seen by some six elements across, whatever is above it.
double spacingAtLump(const SoftBlock& block, const Fineness& fineness, int axis, double at) {
  if (!block.lump) return fineness.coarsest;
  const double away = std::max(0.0, std::abs(at - block.lump->centre[axis]) - block.lump->radius);
  return block.lump->radius / 3 + fineness.growth * away;
}

struct Grid {
  std::vector<double> x, y, z;
  int node(std::size_t i, std::size_t j, std::size_t k) const {
    return static_cast<int>((k * y.size() + j) * x.size() + i);
  }
};

Grid gridOf(const SoftBlock& block, const std::vector<double>& tool_x, double reach,
            const Fineness& fineness) {
  Grid grid;
  grid.x = planes(-block.length / 2, block.length / 2, [&](double x) {
    double nearest = block.length;
    for (const double tool : tool_x) nearest = std::min(nearest, std::abs(x - tool));
    return std::min(spacing(fineness, nearest - reach), spacingAtLump(block, fineness, 0, x));
  });
  grid.y = planes(0, block.width / 2, [&](double y) {
    return std::min(spacing(fineness, y - reach), spacingAtLump(block, fineness, 1, y));
  });
  grid.z = planes(-block.height, 0, [&](double z) {
    return std::min(spacing(fineness, 0.5 * -z), spacingAtLump(block, fineness, 2, z));
  });
  return grid;
}

}  // namespace

BlockMesh meshOf(const SoftBlock& block, const std::vector<double>& tool_x, double tool_radius,
                 const Fineness& fineness) {
  const Grid g = gridOf(block, tool_x, 0.8 * tool_radius, fineness);
  BlockMesh mesh;
  for (const double z : g.z) {
    for (const double y : g.y) {
      for (const double x : g.x) {
        mesh.nodes.emplace_back(x, y, z);
        const bool glued = z == g.z.front();
        mesh.fixed.insert(mesh.fixed.end(), {glued, glued || y == 0, glued});
      }
    }
  }
  for (std::size_t k = 0; k + 1 < g.z.size(); ++k) {
    for (std::size_t j = 0; j + 1 < g.y.size(); ++j) {
      for (std::size_t i = 0; i + 1 < g.x.size(); ++i) {
        const auto ring = [&](std::size_t at) {
          return std::array<int, 4>{g.node(i, j, at), g.node(i + 1, j, at),
                                    g.node(i + 1, j + 1, at), g.node(i, j + 1, at)};
        };
        const auto below = ring(k), above = ring(k + 1);
        mesh.bricks.push_back(
            {below[0], below[1], below[2], below[3], above[0], above[1], above[2], above[3]});
        if (k + 2 == g.z.size()) mesh.top.push_back(above);
      }
    }
  }
  return mesh;
}

}  // namespace palpa::twin

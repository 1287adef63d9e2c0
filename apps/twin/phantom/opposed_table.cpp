#include "apps/twin/phantom/opposed_table.h"

#include <algorithm>
#include <cmath>

namespace palpa::twin {
namespace {

/// f of the first, f of the second, the lump's motion: along and off or up.
using OpposedFigures = Eigen::Matrix<double, 6, 1>;

int eachAway(const OpposedTable& table) { return table.depths * (table.depths + 3) / 2; }

OpposedCell swapped(const OpposedCell& cell) {
  return {{cell.f[1], cell.f[0]}, {cell.lump.x(), -cell.lump.y()}};
}

/// A cell whose depths may stand in either order; both 0: nothing.
OpposedCell cellAt(const OpposedTable& table, int away, int first, int second) {
  if (first < second) return swapped(cellAt(table, away, second, first));
  if (first == 0) return {};
  const int row = (first - 1) * (first + 2) / 2;  // rows of 2, 3, ... cells
  return table.cells[static_cast<std::size_t>(away * eachAway(table) + row + second)];
}

double power(double depth) { return depth > 0 ? std::pow(depth, 1.5) : 0; }

/// Forces over own depth^1.5, which go on evenly to no depth at all; before the axis the mirror
/// image. Depths in steps, beyond the cells as there.
OpposedFigures scaledAt(const OpposedTable& table, int away, int first, int second) {
  const int a = std::min(std::abs(away), table.aways - 1);
  const auto inside = [&](int depth, int least) { return std::clamp(depth, least, table.depths); };
  OpposedFigures figures;
  const OpposedCell one = cellAt(table, a, inside(first, 1), inside(second, 0)),
                    other = cellAt(table, a, inside(first, 0), inside(second, 1)),
                    both = cellAt(table, a, inside(first, 0), inside(second, 0));
  figures << one.f[0] / power(inside(first, 1) * table.depth_step),
      other.f[1] / power(inside(second, 1) * table.depth_step), both.lump;
  if (away < 0)
    for (const int along : {0, 2, 4}) figures[along] *= -1;
  return figures;
}

/// Where a figure lies between two cells.
struct BetweenCells {
  int cell = 0;
  std::array<double, 4> weights{};
  BetweenCells(double at, double high) {
    const double inside = std::clamp(at, 0.0, high);
    cell = static_cast<int>(inside);
    weights = cubicWeights(inside - cell);
  }
};

}  // namespace

double OpposedTable::underAt(double away, double depth) const {
  if (!(depth > 0)) return 0;
  const BetweenCells a(std::abs(away) / away_step, aways - 1.0), d(depth / depth_step, depths);
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    const int row = std::min(std::abs(a.cell + i - 1), aways - 1);
    for (int j = 0; j < 4; ++j) {
      const int at = std::clamp(d.cell + j - 1, 1, depths);
      sum += a.weights[static_cast<std::size_t>(i)] * d.weights[static_cast<std::size_t>(j)] *
             under[static_cast<std::size_t>(row * depths + at - 1)] / power(at * depth_step);
    }
  }
  return sum * power(depth);
}

namespace {

/// At depths d' of both, m, not below zero.
OpposedCell between(const OpposedTable& table, double away, const std::array<double, 2>& met) {
  const BetweenCells a(std::abs(away) / table.away_step, table.aways - 1.0),
      first(met[0] / table.depth_step, table.depths),
      second(met[1] / table.depth_step, table.depths);
  OpposedFigures sum = OpposedFigures::Zero();
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k)
        sum +=
            a.weights[i] * first.weights[j] * second.weights[k] *
            scaledAt(table, a.cell + static_cast<int>(i) - 1, first.cell + static_cast<int>(j) - 1,
                     second.cell + static_cast<int>(k) - 1);
  return {{power(met[0]) * sum.segment<2>(0), power(met[1]) * sum.segment<2>(2)},
          sum.segment<2>(4)};
}

}  // namespace

OpposedCell OpposedTable::at(double away, const std::array<double, 2>& depth, double share) const {
  std::array<double, 2> met{};  // d'
  for (std::size_t t = 0; t < 2; ++t)
    met[t] = std::max(depth[t] + share * underAt(away, depth[1 - t]), 0.0);
  OpposedCell first = between(*this, away, {met[0], share * met[1]});
  if (share == 1) return first;
  const OpposedCell second = between(*this, away, {share * met[0], met[1]});
  return {{first.f[0], second.f[1]}, 0.5 * (first.lump + second.lump)};
}

namespace {

/// The second's depth, m, at which it meets its face by `met` while the first's does by `first`,
/// and so the first's.
std::array<double, 2> depthsFor(const OpposedTable& table, double away, double first,
                                double second) {
  constexpr int kRounds = 40;  // each leaves less than a third
  std::array<double, 2> depth{first, second};
  for (int i = 0; i < kRounds; ++i) {
    depth[0] = first - table.underAt(away, depth[1]);
    depth[1] = second - table.underAt(away, depth[0]);
  }
  return depth;
}

/// From the elements' frame, in which the second presses from below.
OpposedCell cellOf(const BlockResponse& answer) {
  OpposedCell cell;
  cell.f[0] = {answer.f[0].x(), answer.f[0].z()};
  if (answer.f.size() > 1) cell.f[1] = {answer.f[1].x(), -answer.f[1].z()};
  cell.lump = {answer.lump.x(), answer.lump.z()};
  return cell;
}

}  // namespace

OpposedTable tabulateOpposed(const SoftBlock& block, OpposedTable shape, const Fineness& fineness,
                             const Tabulated& progress) {
  shape.cells.clear();
  shape.under.clear();
  const int each = eachAway(shape), all = shape.aways * each;
  for (int a = 0; a < shape.aways; ++a) {
    const double x = a * shape.away_step;
    FiniteBlock solid(block, {x}, shape.tool_radius, fineness);
    std::vector<OpposedCell> alone;
    for (int d = 1; d <= shape.depths; ++d) {
      const BlockResponse answer = solid.press({Vec3(x, 0, -d * shape.depth_step)});
      alone.push_back(cellOf(answer));
      shape.under.push_back(-answer.under);
    }
    OpposedTable here = shape;  // what it gives way at this place is known: of the same aways
    here.aways = 1;
    here.under.assign(shape.under.end() - shape.depths, shape.under.end());
    for (int i = 1; i <= shape.depths; ++i) {
      shape.cells.push_back(alone[static_cast<std::size_t>(i - 1)]);
      for (int j = 1; j <= i; ++j) {
        const std::array<double, 2> depth =
            depthsFor(here, 0, i * shape.depth_step, j * shape.depth_step);
        shape.cells.push_back(
            cellOf(solid.press({Vec3(x, 0, -depth[0]), Vec3(x, 0, -shape.thickness + depth[1])})));
        if (progress) progress(a * each + (i - 1) * (i + 2) / 2 + j + 1, all);
      }
    }
  }
  return shape;
}

}  // namespace palpa::twin

#include "apps/twin/phantom/phantom_table.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpa::twin {
namespace {

/// Catmull-Rom weights of the four cells around.
std::array<double, 4> weights(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {0.5 * (-t3 + 2 * t2 - t), 0.5 * (3 * t3 - 5 * t2 + 2), 0.5 * (-3 * t3 + 4 * t2 + t),
          0.5 * (t3 - t2)};
}

using Figures = Eigen::Array4d;  // f_out, f_up, lump_out, lump_up
const Figures kOddAbout{-1, 1, -1, 1};

/// A cell's figures over depth^1.5, which go on evenly to no depth at all. Cells before the axis
/// mirror those beyond it.
Figures scaled(const PhantomTable& table, int away, int depth) {
  const int a = std::min(std::abs(away), table.aways - 1), d = std::clamp(depth, 1, table.depths);
  const PhantomTable::Cell& cell =
      table.cells[static_cast<std::size_t>(a) * table.depths + (d - 1)];
  const Figures figures(cell.f_out, cell.f_up, cell.lump_out, cell.lump_up);
  return figures / std::pow(d * table.depth_step, 1.5) *
         (away < 0 ? kOddAbout : Figures(Figures::Ones()));
}

}  // namespace

PhantomTable::Cell PhantomTable::at(double away, double depth) const {
  if (!(depth > 0)) return {};
  const double a = std::min(std::abs(away) / away_step, aways - 1.0),
               d = std::clamp(depth / depth_step, 1.0, static_cast<double>(depths));
  const int a0 = static_cast<int>(a), d0 = static_cast<int>(d);
  const auto wa = weights(a - a0), wd = weights(d - d0);
  Figures sum = Figures::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) sum += wa[i] * wd[j] * scaled(*this, a0 + i - 1, d0 + j - 1);
  }
  sum *= std::pow(depth, 1.5);
  const double side = away < 0 ? -1 : 1;
  return {side * sum[0], sum[1], side * sum[2], sum[3]};
}

PhantomTable tabulate(const SoftBlock& block, PhantomTable shape, const Fineness& fineness,
                      const Tabulated& progress) {
  shape.cells.clear();
  for (int a = 0; a < shape.aways; ++a) {
    const double away = a * shape.away_step;
    FiniteBlock solid(block, {away}, shape.tool_radius, fineness);
    for (int d = 1; d <= shape.depths; ++d) {
      const FiniteBlock::Answer answer = solid.press({Vec3(away, 0, -d * shape.depth_step)});
      shape.cells.push_back({answer.f[0].x(), answer.f[0].z(), answer.lump.x(), answer.lump.z()});
      if (progress) progress(a * shape.depths + d, shape.aways * shape.depths);
    }
  }
  return shape;
}

}  // namespace palpa::twin

#include "apps/twin/phantom/phantom_table.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpa::twin {
namespace {

using Figures = Eigen::Array4d;  // f_out, f_up, lump_out, lump_up
const Figures kOddAbout{-1, 1, -1, 1};

/// A cell's figures over depth^1.5, which go on evenly to no depth at all. Cells before the axis
/// mirror those beyond it.
Figures scaled(const PhantomTable& table, int away, int depth) {
  const int a = std::min(std::abs(away), table.aways - 1), d = std::clamp(depth, 1, table.depths);
  const PhantomCell& cell = table.cells[static_cast<std::size_t>(a) * table.depths + (d - 1)];
  const Figures figures(cell.f_out, cell.f_up, cell.lump_out, cell.lump_up);
  return figures / std::pow(d * table.depth_step, 1.5) *
         (away < 0 ? kOddAbout : Figures(Figures::Ones()));
}

}  // namespace

std::array<double, 4> cubicWeights(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {0.5 * (-t3 + 2 * t2 - t), 0.5 * (3 * t3 - 5 * t2 + 2), 0.5 * (-3 * t3 + 4 * t2 + t),
          0.5 * (t3 - t2)};
}

PhantomCell PhantomTable::at(double away, double depth) const {
  if (!(depth > 0)) return {};
  const double a = std::min(std::abs(away) / away_step, aways - 1.0),
               d = std::clamp(depth / depth_step, 1.0, static_cast<double>(depths));
  const int a0 = static_cast<int>(a), d0 = static_cast<int>(d);
  const auto wa = cubicWeights(a - a0), wd = cubicWeights(d - d0);
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
      const BlockResponse answer = solid.press({Vec3(away, 0, -d * shape.depth_step)});
      shape.cells.push_back({answer.f[0].x(), answer.f[0].z(), answer.lump.x(), answer.lump.z()});
      if (progress) progress(a * shape.depths + d, shape.aways * shape.depths);
    }
  }
  return shape;
}

namespace {

using PairFigures =
    Eigen::Matrix<double, 6, 1>;  // f of the first, f of the second, lump: along and up

PairFigures figuresOf(const PairCell& cell) {
  return (PairFigures() << cell.f[0], cell.f[1], cell.lump).finished();
}
PairCell cellOf(const PairFigures& v) {
  return {{v.segment<2>(0), v.segment<2>(2)}, v.segment<2>(4)};
}

/// Each tool as if it were alone.
PairCell alone(const PhantomTable& one, double apart, double shift,
               const std::array<double, 2>& depth) {
  PairCell sum;
  for (std::size_t t = 0; t < 2; ++t) {
    const PhantomCell cell = one.at(shift + (t == 0 ? 0.5 : -0.5) * apart, depth[t]);
    sum.f[t] = {cell.f_out, cell.f_up};
    sum.lump += Eigen::Vector2d(cell.lump_out, cell.lump_up);
  }
  return sum;
}

PairCell mirrored(const PairCell& cell) {
  const auto flip = [](const Eigen::Vector2d& v) { return Eigen::Vector2d(-v.x(), v.y()); };
  return {{flip(cell.f[1]), flip(cell.f[0])}, flip(cell.lump)};
}

/// A cell's figures; the shift may be below zero.
PairFigures together(const PairTable& table, int shift, int first, int second) {
  if (shift < 0) return figuresOf(mirrored(cellOf(together(table, -shift, second, first))));
  return figuresOf(
      table.cells[(static_cast<std::size_t>(shift) * table.depths + (first - 1)) * table.depths +
                  (second - 1)]);
}

/// Lagrange's weights at t of values at low, low + 1, ... high.
std::vector<double> lagrange(double t, int low, int high) {
  std::vector<double> weights;
  for (int i = low; i <= high; ++i) {
    double w = 1;
    for (int j = low; j <= high; ++j) {
      if (j != i) w *= (t - j) / (i - j);
    }
    weights.push_back(w);
  }
  return weights;
}

}  // namespace

PairCell PairTable::at(const PhantomTable& one, double shift,
                       const std::array<double, 2>& depth) const {
  return cellOf(figuresOf(alone(one, apart, shift, depth)) + figuresOf(more(shift, depth)));
}

PairCell PairTable::more(double shift, const std::array<double, 2>& depth) const {
  if (!(depth[0] > 0 && depth[1] > 0)) return {};
  const int far = shifts - 1;
  const auto ws = lagrange(std::clamp(shift / shift_step, -1.0 * far, 1.0 * far), -far, far);
  const auto w0 = lagrange(std::min(depth[0] / depth_step, 1.0 * depths), 0, depths),
             w1 = lagrange(std::min(depth[1] / depth_step, 1.0 * depths), 0, depths);
  PairFigures sum = PairFigures::Zero();
  for (int s = -far; s <= far; ++s) {
    for (int i = 1; i <= depths; ++i) {
      for (int j = 1; j <= depths; ++j)
        sum += ws[static_cast<std::size_t>(s + far)] * w0[static_cast<std::size_t>(i)] *
               w1[static_cast<std::size_t>(j)] * together(*this, s, i, j);
    }
  }
  return cellOf(sum);
}

PairTable tabulatePairs(const SoftBlock& block, const PhantomTable& one, PairTable shape,
                        const Fineness& fineness, const Tabulated& progress) {
  shape.cells.clear();
  const int each = shape.depths * shape.depths;
  for (int s = 0; s < shape.shifts; ++s) {
    const double first = s * shape.shift_step + 0.5 * shape.apart, second = first - shape.apart;
    FiniteBlock solid(block, {second, first}, one.tool_radius, fineness);
    for (int i = 1; i <= shape.depths; ++i) {
      for (int j = 1; j <= shape.depths; ++j) {
        const BlockResponse answer = solid.press(
            {Vec3(first, 0, -i * shape.depth_step), Vec3(second, 0, -j * shape.depth_step)});
        const PairFigures both =
            (PairFigures() << answer.f[0].x(), answer.f[0].z(), answer.f[1].x(), answer.f[1].z(),
             answer.lump.x(), answer.lump.z())
                .finished();
        shape.cells.push_back(
            cellOf(both - figuresOf(alone(one, shape.apart, s * shape.shift_step,
                                          {i * shape.depth_step, j * shape.depth_step}))));
        if (progress) progress(s * each + (i - 1) * shape.depths + j, shape.shifts * each);
      }
    }
  }
  return shape;
}

}  // namespace palpa::twin

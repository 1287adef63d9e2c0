#include "apps/twin/phantom/pair_table.h"

#include <algorithm>
#include <cmath>

namespace palpa::twin {
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
    const PhantomTable::Cell cell = one.at(shift + (t == 0 ? 0.5 : -0.5) * apart, depth[t]);
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
  const PairCell each = alone(one, apart, shift, depth);
  if (!(depth[0] > 0 && depth[1] > 0)) return each;
  const int far = shifts - 1;
  const auto ws = lagrange(std::clamp(shift / shift_step, -1.0 * far, 1.0 * far), -far, far);
  const auto w0 = lagrange(std::min(depth[0] / depth_step, 1.0 * depths), 0, depths),
             w1 = lagrange(std::min(depth[1] / depth_step, 1.0 * depths), 0, depths);
  PairFigures sum = figuresOf(each);
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
        const FiniteBlock::Answer answer = solid.press(
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

#include "haptics/modulation/learnt_map.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {
namespace {

using MapNodes = std::array<float, static_cast<std::size_t>(kMapSide* kMapSide)>;

/// Along one side: the cell, how far in it, and how much of the map still counts.
struct OnSide {
  int cell = 0;
  double share = 0, counts = 0;
};

OnSide onSide(double at, double low, double step, int nodes) noexcept {
  OnSide on;
  const double u = (at - low) / step, last = nodes - 1;
  if (!(step > 0) || nodes < 2 || nodes > kMapSide || !(u > -1 && u < last + 1)) return on;
  const double inside = std::clamp(u, 0.0, last);
  on.cell = std::min(static_cast<int>(inside), nodes - 2);
  on.share = inside - on.cell;
  on.counts = 1 - std::abs(u - inside);
  return on;
}

double betweenNodes(const MapNodes& nodes, int columns, const OnSide& x, const OnSide& y) noexcept {
  const auto row = [&](int j) {
    const std::size_t first = static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                              static_cast<std::size_t>(x.cell);
    return (1 - x.share) * static_cast<double>(nodes[first]) +
           x.share * static_cast<double>(nodes[first + 1]);
  };
  const double value = (1 - y.share) * row(y.cell) + y.share * row(y.cell + 1),
               faded = 1 + x.counts * y.counts * (value - 1);
  return faded > 0 && std::isfinite(faded) ? faded : 1;
}

}  // namespace

MappedPlace placeOn(const LearntMap& map, double x, double y) noexcept {
  const OnSide on_x = onSide(x, static_cast<double>(map.low_x), static_cast<double>(map.step_x),
                             map.columns),
               on_y = onSide(y, static_cast<double>(map.low_y), static_cast<double>(map.step_y),
                             map.rows);
  if (!(on_x.counts > 0 && on_y.counts > 0)) return {};
  return {betweenNodes(map.stiffness, map.columns, on_x, on_y),
          betweenNodes(map.friction, map.columns, on_x, on_y)};
}

StiffnessModulation lawAt(const StiffnessModulation& law, const LearntMap& map,
                          const Vec3& p_P) noexcept {
  const MappedPlace here = placeOn(map, p_P.x(), p_P.y());
  StiffnessModulation local = law;
  local.real.k *= here.stiffness;
  local.real.b *= here.stiffness;
  local.friction.mu *= here.friction;
  return local;
}

}  // namespace palpa::haptics

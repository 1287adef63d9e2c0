#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "haptics/surface/search_surface.h"

/// What these tests share: draws, floors, and their solid written down once more without any index:
/// plain loops over all bumps.
namespace palpa::haptics {

/// Even draws from [0, 1), and from a range.
struct Draws {
  explicit Draws(std::uint64_t seed) : bits(seed) {}
  double operator()() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double from(double low, double high) { return low + (high - low) * (*this)(); }
  std::mt19937_64 bits;
};

inline std::function<double()> evenly(std::uint64_t seed) { return Draws(seed); }
inline SearchSurface searchFloor(std::uint64_t seed, const SearchStimulus& stimulus = {0.7, 1}) {
  return {SearchSpec{}, stimulus, evenly(seed)};
}

/// A pattern whose middles are given: `at` holds wanted ones, every other cell's stays in its
/// cell's middle. For a jitter as wide as the spacing, each in a cell of its own.
inline std::function<double()> placing(const BumpSpec& spec,
                                       const std::vector<BumpPattern::Bump>& at) {
  const int side = static_cast<int>(std::ceil(2 * spec.outer / spec.spacing));
  std::vector<double> draws(static_cast<std::size_t>(2 * side * side), 0.5);
  for (const BumpPattern::Bump& bump : at) {
    const double i = std::floor(bump.x / spec.spacing + 0.5 * side),
                 j = std::floor(bump.y / spec.spacing + 0.5 * side);
    const std::size_t k = static_cast<std::size_t>(2 * (j * side + i));
    draws[k] = 0.5 + (bump.x - (i + 0.5 - 0.5 * side) * spec.spacing) / spec.jitter;
    draws[k + 1] = 0.5 + (bump.y - (j + 0.5 - 0.5 * side) * spec.spacing) / spec.jitter;
  }
  return [draws, k = std::size_t{0}]() mutable { return draws[k++ % draws.size()]; };
}

inline double highestBump(const BumpPattern& pattern, double x, double y) {
  double highest = 0;
  const double r = pattern.spec().radius;
  for (const BumpPattern::Bump& b : pattern.bumps()) {
    const double h2 = r * r - (x - b.x) * (x - b.x) - (y - b.y) * (y - b.y);
    if (h2 > highest * highest) highest = std::sqrt(h2);
  }
  return highest;
}

inline double plainHeight(const SearchSurface& floor, double x, double y) {
  double height = 0;
  for (int e = 0; e < SearchSurface::kElements; ++e) {
    const auto [mx, my] = floor.middle(e);
    const double r = std::hypot(x - mx, y - my);
    height += floor.pit().height(r) + floor.groove().height(r - floor.spec().groove);
    height += highestBump(floor.texture(e), x - mx, y - my);
  }
  return height;
}

/// From a point to the nearest of the way from a to b.
inline double toWay(double x, double y, double ax, double ay, double bx, double by) {
  const Eigen::Vector2d a(ax, ay), way(bx - ax, by - ay), p(x, y);
  const double length2 = way.squaredNorm(),
               share = length2 > 0 ? std::clamp((p - a).dot(way) / length2, 0.0, 1.0) : 0;
  return (p - a - share * way).norm();
}

/// Heights of the bumps whose footprints b is in; where there is none, of those that the way from
/// a to b enters from outside. `unsure`: rounding decides.
struct WayOverBumps {
  std::vector<double> heights;
  bool unsure = false;
};
inline WayOverBumps plainWay(const SearchSurface& floor, double ax, double ay, double bx,
                             double by) {
  WayOverBumps under, entered;
  bool unsure = false;
  for (int e = 0; e < SearchSurface::kElements; ++e) {
    const auto [mx, my] = floor.middle(e);
    const double radius = floor.texture(e).spec().radius;
    for (const BumpPattern::Bump& b : floor.texture(e).bumps()) {
      const double x = mx + b.x, y = my + b.y, from_a = std::hypot(ax - x, ay - y),
                   from_b = std::hypot(bx - x, by - y), from_way = toWay(x, y, ax, ay, bx, by);
      for (const double d : {from_a, from_b, from_way})
        unsure = unsure || std::abs(d - radius) < 1e-9;
      if (from_b < radius)
        under.heights.push_back(radius);
      else if (from_a >= radius && from_way < radius)
        entered.heights.push_back(radius);
    }
  }
  WayOverBumps& way = under.heights.empty() ? entered : under;
  way.unsure = unsure;
  return way;
}

/// How deep p lies in what is not free, as a length that is no more than the distance to the free
/// space: under the smooth height, in a ball, beyond a wall.
inline double plainDepth(const SearchSurface& floor, const Vec3& p) {
  const double half = 0.5 * floor.spec().side;
  double depth = std::max({std::abs(p.x()) - half, std::abs(p.y()) - half, 0.0});
  double smooth = 0;
  for (int e = 0; e < SearchSurface::kElements; ++e) {
    const auto [mx, my] = floor.middle(e);
    const double r = std::hypot(p.x() - mx, p.y() - my);
    smooth += floor.pit().height(r) + floor.groove().height(r - floor.spec().groove);
    for (const BumpPattern::Bump& b : floor.texture(e).bumps()) {
      const double across = std::hypot(p.x() - mx - b.x, p.y() - my - b.y),
                   radius = floor.texture(e).spec().radius;
      const double in =
          p.z() >= 0 ? radius - std::hypot(across, p.z()) : std::min(radius - across, -p.z());
      depth = std::max(depth, in);
    }
  }
  return std::max(depth, std::min(smooth - p.z(), 1.0));
}

}  // namespace palpa::haptics

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "haptics/modulation/modulation.h"

/// What a real object is like from place to place, where it is not the same everywhere: learnt by
/// touch, before a session.
namespace palpa::haptics {

inline constexpr int kMapSide = 33;  ///< nodes along a side, at most [chosen: 3 mm on 100 mm]

/// By how much an object is stiffer and rougher than its one law says, at the nodes of a grid in
/// the plane z = 0 of P: columns along x, rows along y, row by row from the lowest y.
struct LearntMap {
  std::int32_t columns = 0, rows = 0;  ///< 2 to kMapSide; 0: there is no map
  float low_x = 0, low_y = 0;          ///< m, the first node
  float step_x = 0, step_y = 0;        ///< m
  std::array<float, static_cast<std::size_t>(kMapSide*kMapSide)> stiffness{},
      friction{};  ///< times the law's
};
static_assert(std::is_trivially_copyable_v<LearntMap>);

struct MappedPlace {
  double stiffness = 1, friction = 1;  ///< times the law's
};

/// Bilinear between the nodes. Beyond the rim the map fades within one step, so that nothing jumps
/// under a tool that slides off it: t from 1 at the rim to 0,
///     s(p) = 1 + t (s(rim) - 1)
/// 1 farther out, without a map, and for places and figures that are no numbers. No allocation, no
/// exception.
MappedPlace placeOn(const LearntMap& map, double x, double y) noexcept;

/// The object's law under a tool at p_P, m, in P:
///     k(p) = s(p) k,   b(p) = s(p) b,   mu(p) = r(p) mu
/// m and x0 stay, as the shape of the law; sigma and B, which no map tells. The target: a constant
/// stays, a factor is of the object as it is there.
StiffnessModulation lawAt(const StiffnessModulation& law, const LearntMap& map,
                          const Vec3& p_P) noexcept;

}  // namespace palpa::haptics

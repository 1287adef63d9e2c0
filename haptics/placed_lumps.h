#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "anatomy/geometry/pose.h"

namespace palpa::haptics {

inline constexpr int kMostLumps = 6, kMostLumpKinds = 8;

/// A virtual lump of one of a session's kinds, at a place.
struct PlacedLump {
  Packed3 p_T0{};          ///< m, where it rests
  std::uint32_t kind = 0;  ///< 1 to kMostLumpKinds; else there is none
  std::uint32_t reserved = 0;
};
using PlacedLumps = std::array<PlacedLump, kMostLumps>;
static_assert(std::is_trivially_copyable_v<PlacedLumps>);

}  // namespace palpa::haptics

#pragma once

#include <cstdint>

#include "haptics/surface/floor.h"

namespace palpa::runtime {

/// Floors by number, asked for by the haptic thread: what is given stays as it is while a tick may
/// name its number.
class FloorSource {
 public:
  virtual ~FloorSource() = default;
  /// Null: there is none (yet). Neither waits nor allocates.
  virtual const haptics::Floor* floor(std::uint32_t number) const noexcept = 0;
};

}  // namespace palpa::runtime

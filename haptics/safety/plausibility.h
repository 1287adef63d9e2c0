#pragma once

#include <type_traits>

#include "anatomy/geometry/local_geometry.h"
#include "haptics/contact/needle_contact.h"
#include "haptics/device.h"
#include "haptics/safety/safety_limiter.h"

namespace palpa::haptics {

/// Nothing that a desktop device can touch is farther from its base, m.
inline constexpr double kFarthest = 10;

/// Whether a snapshot can be what its maker meant: numbered, counts within their arrays, every
/// number finite and no farther than kFarthest, normals of unit length, organs and tissues that
/// exist. Only the entries that are in use are looked at. Costs about as much as copying the
/// snapshot.
bool plausible(const LocalGeometry& geometry) noexcept;

/// Whether a device can be there: finite, near its base, the quaternion about of unit length.
bool possible(const DeviceReading& reading) noexcept;

/// What is remembered of the readings to tell motion from a jump. Frame D.
struct ReadingState {
  Packed3 p_DE{}, p_DT{};
  std::uint64_t sequence = 0;
  double since_ns = 0;  ///< since the position was last new
  double hold_ns = 0;   ///< still to be steady after a jump
  std::uint8_t started = 0;
  std::uint8_t reserved[7]{};
};
static_assert(std::is_trivially_copyable_v<ReadingState>);

/// A jump: gimbal or tip moved farther than max_speed x (time since the last new reading + period);
/// the period because readings and ticks are not in step. Time counts up to silent_ns. After a jump
/// the readings are not believed until they have been steady for jump_hold_ns. Returns whether they
/// are.
bool steady(const SafetyLimits& limits, std::int64_t period_ns, const NeedlePose& pose,
            std::uint64_t sequence, double elapsed_ns, ReadingState& state) noexcept;

}  // namespace palpa::haptics

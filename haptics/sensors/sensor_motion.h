#pragma once

#include <cstdint>
#include <type_traits>

#include "haptics/sensors/tool_load.h"

namespace palpa::haptics {

struct MotionSettings {
  double rate_Hz = 1000;        ///< of the poses
  Packed3 g_W{0, 0, -9.80665};  ///< m/s^2; standard gravity (CGPM 1901), W has +z up
};

/// The last two poses and what they gave. Trivially copyable.
struct MotionState {
  PackedPose X_WS_0, X_WS_1;  ///< the older, the newer
  std::int64_t t_0_ns = 0, t_1_ns = 0;
  std::int32_t poses = 0;  ///< seen without a gap; stays at 3
  std::int32_t reserved = 0;
  SensorMotion motion;
};
static_assert(std::is_trivially_copyable_v<MotionState>);

/// Motion of S at the pose before the newest one, by central differences over three poses 0, 1, 2,
/// h = (t_2 - t_0)/2, v the displacement in a step over its time, w the rotation vector in a
/// step over its time:
///
///   a = (v_12 - v_01)/h,   alpha = (w_12 - w_01)/h,   omega = (w_01 + w_12)/2
///
/// Relative error (2 pi f h)^2 / 12 for a motion at f: 8e-5 at 5 Hz. A step shorter than half a
/// period (the same reading twice) keeps the last motion; one longer than four, or back in time,
/// begins anew. With fewer than three poses there is gravity alone. No allocation, no exception.
const SensorMotion& observe(const MotionSettings& settings, MotionState& state,
                            const PackedPose& X_WS, std::int64_t t_ns) noexcept;

}  // namespace palpa::haptics

#pragma once

#include <type_traits>

#include "haptics/sensors/force_sensor.h"
#include "haptics/sensors/low_pass.h"
#include "haptics/sensors/sensor_motion.h"
#include "haptics/sensors/tool_load.h"

namespace palpa::haptics {

/// From what the sensor shows to what the world does to the tool:
///
///   (f, tau)_contact = L[ (f, tau)_meas - bias - (f, tau)_tool ]        signs: tool_load.h
///
/// (f, tau)_tool from the motion of S one call ago, so the measurement of one call ago is taken; L
/// is one low-pass over the difference, so that what is measured and what is computed are delayed
/// alike, and so is the place where it touches: who sets force against depth must take both of one
/// time. Delay of the whole: one call + sqrt(2)/(2 pi f_c).
struct WrenchFilter {
  LowPass low_pass;
  MotionSettings motion;
  ToolLoad tool;
  Wrench bias;
  Packed3 p_SK{};  ///< m: the point that touches things
};

struct WrenchFilterState {
  MotionState motion;
  LowPassState<6> low_pass;
  Wrench before;              ///< measured one call ago
  std::uint32_t held = 0;     ///< `before` is there
  std::uint32_t settled = 0;  ///< the low-pass has begun
  LowPassState<3> place;
  Packed3 place_before{};  ///< of K one call ago, m
};
static_assert(std::is_trivially_copyable_v<WrenchFilterState>);

/// Reaction of the world on the tool: force and torque about the origin of S, in S.
struct ContactWrench {
  Wrench contact;
  bool valid = false;  ///< false: sample unusable, or motion not known yet; zero
  Packed3
      p_WK{};  ///< m, where K was, as late as the wrench is; while that is not valid, where it is
};

/// Flags of samples that are not used. An overload is used: it is large, if not exact.
inline constexpr std::uint32_t kUnusable = kNothingYet | kSilent | kFault | kSaturated;

/// One tick: `sample` and the pose of S in W, both of time `t_ns`. It takes three poses and two
/// samples to begin; after an unusable or not finite input, or a gap, it begins anew. No
/// allocation, no exception.
ContactWrench step(const WrenchFilter& filter, WrenchFilterState& state, const WrenchSample& sample,
                   const PackedPose& X_WS, std::int64_t t_ns) noexcept;

}  // namespace palpa::haptics

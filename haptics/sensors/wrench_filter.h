#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "haptics/sensors/force_sensor.h"
#include "haptics/sensors/tool_load.h"

namespace palpa::haptics {

/// Second-order Butterworth low-pass, by the bilinear transform with the cut-off prewarped:
///
///   H(s) = 1 / (s^2 + sqrt(2) s + 1),   s = (1/K) (1 - z^-1)/(1 + z^-1),   K = tan(pi f_c / f_s)
///   y = b0 x + b1 x z^-1 + b2 x z^-2 - a1 y z^-1 - a2 y z^-2
///
/// Gain 1 at rest, 1/sqrt(2) at f_c, 0 at f_s/2. Delay of slow signals sqrt(2)/(2 pi f_c).
/// Source: Oppenheim, Schafer, Discrete-Time Signal Processing, ch. 7 (bilinear transform,
/// Butterworth).
struct LowPass {
  double b0 = 1, b1 = 0, b2 = 0, a1 = 0, a2 = 0;
};

/// f_c = `cutoff_Hz` between 0 and half of f_s = `rate_Hz`; throws UsageError elsewhere.
LowPass butterworth(double cutoff_Hz, double rate_Hz);

/// Memory of a filter over N channels, transposed direct form II. All zero: at rest at zero.
template <std::size_t N>
struct LowPassState {
  std::array<double, N> z1{}, z2{};
};

/// As if `x` had been the input for ever.
template <std::size_t N>
void settle(const LowPass& filter, LowPassState<N>& state,
            const std::array<double, N>& x) noexcept {
  for (std::size_t i = 0; i < N; ++i) {
    state.z1[i] = (1 - filter.b0) * x[i];
    state.z2[i] = (filter.b2 - filter.a2) * x[i];
  }
}

template <std::size_t N>
std::array<double, N> apply(const LowPass& filter, LowPassState<N>& state,
                            const std::array<double, N>& x) noexcept {
  std::array<double, N> y;
  for (std::size_t i = 0; i < N; ++i) {
    y[i] = filter.b0 * x[i] + state.z1[i];
    state.z1[i] = filter.b1 * x[i] - filter.a1 * y[i] + state.z2[i];
    state.z2[i] = filter.b2 * x[i] - filter.a2 * y[i];
  }
  return y;
}

static_assert(std::is_trivially_copyable_v<LowPassState<6>>);

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
  /// m, where K was, as late as the wrench is; while that is not valid, where it is
  Packed3 p_WK{};
};

/// One tick: `sample` and the pose of S in W, both of time `t_ns`. It takes three poses and two
/// samples to begin; after an unusable or not finite input, or a gap, it begins anew. No
/// allocation, no exception.
ContactWrench step(const WrenchFilter& filter, WrenchFilterState& state, const WrenchSample& sample,
                   const PackedPose& X_WS, std::int64_t t_ns) noexcept;

}  // namespace palpa::haptics

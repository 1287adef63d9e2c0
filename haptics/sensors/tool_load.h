#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "anatomy/geometry/pose.h"

namespace palpa::haptics {

/// Every one of the numbers is.
bool finite(const auto& values) noexcept {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Force and torque about the origin of S, both in S. N, N m.
struct Wrench {
  Packed3 f_S{0, 0, 0};
  Packed3 tau_S{0, 0, 0};
};

/// The rigid body that the sensor carries: all that moves beyond its measuring element.
struct ToolLoad {
  double mass = 0;                  ///< kg
  Packed3 p_SM{0, 0, 0};            ///< centre of mass M in S, m
  std::array<double, 6> inertia{};  ///< about M, axes of S: xx yy zz xy xz yz, kg m^2; 0: a point
};

/// How S moves, seen in S itself; g is gravity, downwards.
struct SensorMotion {
  Packed3 a_S{0, 0, 0};      ///< acceleration of the origin of S, m/s^2
  Packed3 omega_S{0, 0, 0};  ///< angular velocity, rad/s
  Packed3 alpha_S{0, 0, 0};  ///< angular acceleration, rad/s^2
  Packed3 g_S{0, 0, 0};      ///< gravity, m/s^2
};

/// What the sensor shows of the tool alone, with nothing touching it. The sensor measures what the
/// tool exerts on it, (f_meas, tau_meas); by Newton's third law the tool feels the opposite.
/// Newton and Euler for the tool, all in S, a_M the acceleration of the centre of mass, r = p_SM:
///
///   m a_M = m g + f_contact - f_meas
///   J alpha + omega x J omega + r x m a_M = r x m g + tau_contact - tau_meas
///   a_M = a + alpha x r + omega x (omega x r)
///
/// With f_contact = 0 this is
///
///   f_tool   = m (g - a_M)                                    at rest: the weight, downwards
///   tau_tool = r x f_tool - J alpha - omega x J omega
///
/// and the reaction of the world on the tool is f_contact = f_meas - bias - f_tool, torque
/// likewise. Source: Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 2.
Wrench toolWrench(const ToolLoad& tool, const SensorMotion& motion) noexcept;

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

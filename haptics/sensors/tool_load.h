#pragma once

#include <array>

#include "anatomy/geometry/pose.h"

namespace palpa::haptics {

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

}  // namespace palpa::haptics

#include "haptics/sensors/tool_load.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/pinned_math.h"

namespace palpa::haptics {

Wrench toolWrench(const ToolLoad& tool, const SensorMotion& motion) noexcept {
  const auto& i = tool.inertia;
  Mat3 J;
  J << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  const Vec3 r = unpack(tool.p_SM), omega = unpack(motion.omega_S), alpha = unpack(motion.alpha_S);
  const Vec3 a_M = unpack(motion.a_S) + alpha.cross(r) + omega.cross(omega.cross(r));
  const Vec3 f = tool.mass * (unpack(motion.g_S) - a_M);
  const Vec3 tau = r.cross(f) - J * alpha - omega.cross(J * omega);
  return {pack(f), pack(tau)};
}

namespace {

/// Rotation vector that takes q_a to q_b, in the axes of either.
Vec3 rotationVector(const Quat& q_a, const Quat& q_b) noexcept {
  const Quat d = q_a.conjugate() * q_b;
  const double s = d.vec().norm(), c = std::abs(d.w());
  const double half_sinc = s < 1e-12 ? 1 : pinned::atan2(s, c) / s;
  return (d.w() < 0 ? -2 : 2) * half_sinc * d.vec();
}

SensorMotion atRest(const MotionSettings& settings, const PackedPose& X_WS) noexcept {
  SensorMotion motion;
  motion.g_S = pack(Vec3(unpack(X_WS.q).conjugate() * unpack(settings.g_W)));
  return motion;
}

SensorMotion differences(const MotionSettings& settings, const MotionState& state,
                         const PackedPose& X_WS, std::int64_t t_ns) noexcept {
  const double h_01 = static_cast<double>(state.t_1_ns - state.t_0_ns) * 1e-9;
  const double h_12 = static_cast<double>(t_ns - state.t_1_ns) * 1e-9;
  const double h = 0.5 * (h_01 + h_12);
  const Quat q_0 = unpack(state.X_WS_0.q), q_1 = unpack(state.X_WS_1.q), q_2 = unpack(X_WS.q);
  const Vec3 p_0 = unpack(state.X_WS_0.p), p_1 = unpack(state.X_WS_1.p), p_2 = unpack(X_WS.p);
  const Vec3 omega_01 = rotationVector(q_0, q_1) / h_01, omega_12 = rotationVector(q_1, q_2) / h_12;
  const Vec3 a_W = ((p_2 - p_1) / h_12 - (p_1 - p_0) / h_01) / h;
  SensorMotion motion = atRest(settings, state.X_WS_1);
  motion.a_S = pack(Vec3(q_1.conjugate() * a_W));
  motion.omega_S = pack(Vec3(0.5 * (omega_01 + omega_12)));
  motion.alpha_S = pack(Vec3((omega_12 - omega_01) / h));
  return motion;
}

}  // namespace

const SensorMotion& observe(const MotionSettings& settings, MotionState& state,
                            const PackedPose& X_WS, std::int64_t t_ns) noexcept {
  const double periods = static_cast<double>(t_ns - state.t_1_ns) * 1e-9 * settings.rate_Hz;
  if (std::abs(periods) > 4) state.poses = 0;
  if (state.poses > 0 && periods < 0.5) return state.motion;
  state.motion =
      state.poses >= 2 ? differences(settings, state, X_WS, t_ns) : atRest(settings, X_WS);
  state.X_WS_0 = state.X_WS_1;
  state.t_0_ns = state.t_1_ns;
  state.X_WS_1 = X_WS;
  state.t_1_ns = t_ns;
  state.poses = std::min(state.poses + 1, 3);
  return state.motion;
}

}  // namespace palpa::haptics

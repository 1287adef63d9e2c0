#include "haptics/sensors/tool_load.h"

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

}  // namespace palpa::haptics

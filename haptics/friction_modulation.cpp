#include "haptics/friction_modulation.h"

namespace palpa::haptics {

Modulated modulateFriction(const FrictionModulation& law, const Vec3& f_r, const Vec3& dp,
                           double dt, FrictionModulationState* state) noexcept {
  Modulated now = modulateStiffness(law.contact, f_r, dp, dt, &state->contact);
  if (!now.contact) {
    state->wanted = {};
    return now;
  }
  const Vec3 f_real = f_r - f_r.dot(now.u_n) * now.u_n;
  now.f_d -= dragOf(law.wanted, now.slid, now.u_n, now.f_n, dt, &state->wanted) + f_real;
  return now;
}

}  // namespace palpa::haptics

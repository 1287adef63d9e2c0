#include "haptics/safety/passivity.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {
namespace {

/// Without force nothing is stored: a contact that is over leaves no credit to the next one.
void settle(const PassivityLimits& limits, PassivityState& state, double force, double dt) {
  state.energy_J = std::min(state.energy_J, force * limits.reach);
  if (state.energy_J < 0) state.energy_J *= 1 - std::min(dt / limits.forget_tau, 1.0);
}

}  // namespace

Vec3 keepPassive(const PassivityLimits& limits, PassivityState& state,
                 const PassivityInput& in) noexcept {
  state.injecting = 0;
  const Vec3 f_port = in.f_D - in.f_source_D + in.f_object_D;
  if (!in.p_DE.allFinite() || !f_port.allFinite()) {
    state = PassivityState{};
    return in.f_D;
  }
  state.since_s += in.dt;
  if (state.started && !in.fresh) {
    state.injecting = unpack(state.added_D).squaredNorm() > 0;
    return in.f_D + unpack(state.added_D);
  }
  const double dt = state.since_s;
  state.since_s = 0;
  const Vec3 dx = state.started ? Vec3(in.p_DE - unpack(state.p_last_D)) : Vec3::Zero();
  const double slip = limits.coulomb * dx.norm();
  state.energy_J += -unpack(state.f_last_D).dot(dx) + slip;
  Vec3 added = Vec3::Zero();
  const double expected = state.energy_J - f_port.dot(dx) + slip;
  const double debt = -expected - limits.unfelt_J, moved2 = dx.squaredNorm();
  const bool touching = f_port.squaredNorm() > 0;
  if (touching && debt > 0 && moved2 > 0 && limits.max_damping > 0 && dt > 0) {
    const double damping = std::min(debt * dt / moved2, limits.max_damping);
    added = -damping * dx / dt;
    state.injecting = 1;
  }
  settle(limits, state, f_port.norm(), dt);
  state.added_D = pack(added);
  state.f_last_D = pack(Vec3(in.f_D - in.f_source_D + added + in.f_object_D));
  state.p_last_D = pack(in.p_DE);
  state.started = 1;
  return in.f_D + added;
}

double couplingStiffness(const DeviceCapabilities& device, double period_s, double virtual_damping,
                         double grip_damping) noexcept {
  if (!(period_s > 0)) return 0;
  const double damping = device.viscous_damping + grip_damping;
  double stiffness = (damping - std::abs(virtual_damping)) / (period_s / 2 + device.delay);
  if (device.coulomb_friction > 0 && device.position_resolution > 0)
    stiffness = std::min(stiffness, 2 * device.coulomb_friction / device.position_resolution);
  if (device.stable_stiffness > 0) stiffness = std::min(stiffness, device.stable_stiffness);
  return std::max(stiffness, 0.0);
}

}  // namespace palpa::haptics

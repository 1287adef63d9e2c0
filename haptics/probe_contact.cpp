#include "haptics/probe_contact.h"

#include <algorithm>
#include <cmath>

#include "haptics/bone_contact.h"

namespace palpa::haptics {
namespace {

void followProbe(const CouplingLimits& coupling, const Vec3& p, double dt, ProbeState& state) {
  if (state.started && dt > 0) {
    const Vec3 v = (p - unpack(state.p_DT)) / dt;
    const double share = dt / (coupling.velocity_tau + dt);
    state.v_D = pack(Vec3(unpack(state.v_D) + share * (v - unpack(state.v_D))));
  }
  state.p_DT = pack(p);
  state.started = 1;
}

Vec3 slide(const ProbeMaterials& m, const Vec3& p, const Vec3& n, double normal_force,
           ProbeState& state) {
  if (!state.touching) state.anchor_D = pack(p);
  Vec3 drag = p - unpack(state.anchor_D);
  drag -= drag.dot(n) * n;
  const double largest = m.shear > 0 ? m.friction * normal_force / m.shear : 0;
  if (drag.norm() > largest) drag *= largest / std::max(drag.norm(), 1e-12);
  state.anchor_D = pack(Vec3(p - drag));
  return -m.shear * drag;
}

}  // namespace

NeedleContact probeContact(const ProbeMaterials& materials, const CouplingLimits& coupling,
                           const LocalGeometry& geometry, const Vec3& p_DT, double dt,
                           ProbeState& state) noexcept {
  NeedleContact out;
  followProbe(coupling, p_DT, dt, state);
  if (geometry.number == 0) return out;
  const PatchContact skin = nearestOn(geometry.skin, p_DT);
  const double x = materials.radius - skin.distance;
  if (x > 0) {
    const double k = std::min(materials.stiffness, coupling.stiffness);
    const double v = unpack(state.v_D).dot(skin.normal);
    out.indentation = x;
    const double elastic = relaxed(materials.relaxation, state.relaxation, k * x, dt);
    out.skin_force = std::max(elastic - materials.damping * v, 0.0);
    out.f_D = out.skin_force * skin.normal + slide(materials, p_DT, skin.normal, out.skin_force, state);
    out.tissue = Tissue::skin;
  }
  if (x <= 0) state.relaxation = RelaxationState{};
  state.touching = x > 0;
  BoneContact deepest;
  for (int i = 0; i < geometry.bone_count; ++i) {
    const BoneContact c = bonePenetration(geometry.bones[i], p_DT, p_DT, materials.radius);
    if (c.penetration > deepest.penetration) deepest = c;
  }
  if (deepest.penetration > 0) {
    out.bone_force = coupling.stiffness * deepest.penetration;
    out.f_D += out.bone_force * deepest.n_D;
  }
  if (deepest.organ != Organ::none && state.bone == Organ::none) out.events |= kBoneTouched;
  if (deepest.organ == Organ::none && state.bone != Organ::none) out.events |= kBoneLeft;
  state.bone = deepest.organ;
  return out;
}

}  // namespace palpa::haptics

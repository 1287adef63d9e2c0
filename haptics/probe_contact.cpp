#include "haptics/probe_contact.h"

#include <algorithm>

namespace palpa::haptics {

NeedleContact probeContact(const ProbeMaterials& materials, const CouplingLimits& coupling,
                           const LocalGeometry& geometry, const Vec3& p_DT, double dt,
                           ProbeState& state) noexcept {
  NeedleContact out;
  follow(state.motion, p_DT, coupling.velocity_tau, dt);
  if (geometry.number == 0) return out;
  const PatchContact skin = nearestOn(geometry.skin, p_DT);
  const double x = materials.radius - skin.distance;
  if (x > 0) {
    const double k = std::min(materials.stiffness, coupling.stiffness);
    const double v = unpack(state.motion.v_D).dot(skin.normal);
    out.indentation = x;
    const double elastic = relaxed(materials.relaxation, state.relaxation, k * x, dt);
    out.skin_force = std::max(elastic - materials.damping * v, 0.0);
    if (!state.touching) state.anchor_D = pack(p_DT);
    out.f_D = out.skin_force * skin.normal + dragAcross(state.anchor_D, p_DT, skin.normal,
                                                        materials.shear,
                                                        materials.friction * out.skin_force);
    out.tissue = Tissue::skin;
  }
  if (x <= 0) state.relaxation = RelaxationState{};
  state.touching = x > 0;
  const BoneTouch touch =
      touchBones(geometry, p_DT, p_DT, materials.radius, coupling.stiffness, state.bone);
  for (int i = 0; i < touch.count; ++i) out.f_D += touch.each[i].f_D;
  out.bone_force = touch.largest;
  out.events |= touch.events;
  state.bone = touch.organ;
  return out;
}

}  // namespace palpa::haptics

#include "haptics/contact/probe_contact.h"

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

FloorTouch touchFloor(const SearchSurface& surface, const FloorGains& gains, double stiffest,
                      double unit, const Vec3& p_F, const Vec3& v_F) noexcept {
  FloorTouch touch;
  touch.p_U = p_F / unit;
  touch.v_F = v_F;
  touch.place = surface.place(touch.p_U.x(), touch.p_U.y());
  const Vec3 e = unit * (surface.closestFree(touch.p_U) - touch.p_U);
  touch.penetration = e.norm();
  if (touch.penetration <= 0) return touch;
  touch.touching = true;
  const Vec3 u = e / touch.penetration;
  const double push =
      std::min(gains.stiffness, stiffest) * touch.penetration - gains.damping * v_F.dot(u);
  touch.f_F = std::max(push, 0.0) * u;
  return touch;
}

std::uint8_t placeBits(const FloorTouch& touch) noexcept {
  const int bits = (touch.place.element + 1) | (touch.place.texture ? kPlaceTexture : 0) |
                   (touch.place.pit ? kPlacePit : 0) | (touch.touching ? kPlaceTouching : 0);
  return static_cast<std::uint8_t>(bits);
}

}  // namespace palpa::haptics

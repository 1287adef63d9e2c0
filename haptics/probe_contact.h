#pragma once

#include <type_traits>

#include "haptics/materials/probe_materials.h"
#include "haptics/needle_contact.h"

namespace palpa::haptics {

struct ProbeState {
  PointMotion motion;  ///< of the tip's centre
  RelaxationState relaxation;
  Packed3 anchor_D{};  ///< stick point of the tip on the surface
  Organ bone = Organ::none;
  std::uint8_t touching = 0;
  std::uint8_t reserved[6]{};
};
static_assert(std::is_trivially_copyable_v<ProbeState>);

/// One evaluation of a ball (centre p_DT, radius of the materials) against the curved skin and the
/// bones under it:
///   skin   (k x - b v_n) n, the first part relaxing, never pulling; across it stick-slip friction
///   with the limit mu f_n bone   K_c x along the normal between ball and capsule
/// x: penetration, m; v_n: velocity along the outward normal. k and b in series with the coupling:
/// k <= K_c. Advances `state`. No allocation, no exception.
NeedleContact probeContact(const ProbeMaterials& materials, const CouplingLimits& coupling,
                           const LocalGeometry& geometry, const Vec3& p_DT, double dt,
                           ProbeState& state) noexcept;

}  // namespace palpa::haptics

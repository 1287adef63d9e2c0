#pragma once

#include <type_traits>

#include "haptics/contact/contact_parts.h"
#include "haptics/contact/needle_materials.h"

namespace palpa::haptics {

/// All that the needle's contact remembers from tick to tick. Frame D.
struct NeedleState {
  Packed3 entry_D{};           ///< where the skin was punctured
  Packed3 skin_anchor_D{};     ///< stick point of the needle's point on the skin
  double friction_anchor = 0;  ///< axial stick point, m of insertion
  Packed3 release_D{};         ///< what is left of the force that a punctured layer had stored, N
  RelaxationState relaxation;  ///< of the skin before the puncture
  RelaxationState wall_relaxation;  ///< of the wall that is being pushed
  PointMotion motion;               ///< of the tip
  std::uint32_t walls_front = 0;    ///< bit per Organ: front wall punctured
  std::uint32_t walls_back = 0;     ///< bit per Organ: back wall punctured
  NeedlePhase phase = NeedlePhase::outside;
  Organ bone = Organ::none;
  Organ pushed = Organ::none;  ///< the wall that is being pushed
  std::uint8_t pushed_leaving = 0;
  std::uint8_t skin_punctures = 0;
  /// the point has been, since this state began or the needle was withdrawn
  std::uint8_t was_outside = 0;
  std::uint8_t reserved[2]{};
};
static_assert(std::is_trivially_copyable_v<NeedleState>);

/// The needle's pose in this tick: tip p_DT, unit axis a_D toward the tip, gimbal p_DE.
struct NeedlePose {
  Vec3 p_DT, a_D, p_DE;
};

struct NeedleContact {
  Vec3 f_D = Vec3::Zero();    ///< resultant on the tool, N
  Vec3 tau_D = Vec3::Zero();  ///< moment about E, N m
  double indentation = 0, depth = 0, v_axial = 0;
  double skin_force = 0, bone_force = 0, wall_force = 0;
  std::uint32_t events = 0;
  Tissue tissue = Tissue::air;
  Organ wall = Organ::none;
  bool wall_leaving = false;
};

/// One evaluation of the needle force (Tzafestas et al. 2008, with cutting, shaft friction and wall
/// punctures after Okamura et al. 2004):
///   before puncture   n F(u), relaxing, in series with the coupling; Coulomb friction across
///   after             axial: -b_layer v - stick-slip(cutting + friction x length)
///                     lateral: -k_t x_t about the entry
///   walls             K_w x, relaxing, at most K_c x; gives way at peak x wall_scale; what it had
///                     stored is let go within `release_tau`, never more than was felt
///   always            bone: K_c x penetration of tip and shaft into the capsules, along the
///                     contact normal
/// A needle that is in the tissue from the first tick on, or that was withdrawn along skin that
/// bulges, feels nothing until its point has been outside once. A point 5 mm out of the skin is
/// out, wherever it entered. No force of skin or wall exceeds the one at which they give way.
/// Advances `state`. No allocation, no exception.
NeedleContact needleContact(const NeedleMaterials& materials, const CouplingLimits& coupling,
                            const LocalGeometry& geometry, const NeedlePose& pose,
                            const TickCommands& commands, double dt, NeedleState& state) noexcept;

}  // namespace palpa::haptics

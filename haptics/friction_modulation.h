#pragma once

#include <type_traits>

#include "haptics/stiffness_modulation.h"

/// A real surface that is felt rougher or smoother than it is: the device adds what the wanted
/// friction has and the real one lacks (Jeon, Choi & Harders 2015, their 10.21).
namespace palpa::haptics {

struct FrictionModulation {
  StiffnessModulation contact;  ///< what finds the normal: the real object's law and friction, and
                                ///< the stiffness to be felt
  Dahl wanted;                  ///< of the surface that is to be felt, from a library or identified
};

struct FrictionModulationState {
  StiffnessModulationState contact;
  DahlState wanted;
};
static_assert(std::is_trivially_copyable_v<FrictionModulation> &&
              std::is_trivially_copyable_v<FrictionModulationState>);

/// In the tangent plane of the normal u_n that modulateStiffness finds, with the real normal force
/// f_n:
///     f_real = f_r - f_n u_n          as sensed, not as modelled
///     f_targ = -drag(wanted)
///     f_d = (k~ x - f_n) u_n + f_targ - f_real
/// What is pressed decides how much it rubs: friction follows the real normal force, whatever
/// stiffness is felt. Zero off contact. No allocation, no exception.
Modulated modulateFriction(const FrictionModulation& law, const Vec3& f_r, const Vec3& dp,
                           double dt, FrictionModulationState* state) noexcept;

}  // namespace palpa::haptics

#pragma once

#include <type_traits>

#include "anatomy/geometry/pose.h"
#include "haptics/materials/dahl.h"
#include "haptics/materials/hunt_crossley.h"

/// A real object that feels harder or softer than it is: the device adds to what the object gives
/// back (Jeon, Choi & Harders 2015, their section 3).
namespace palpa::haptics {

/// What is to be felt instead of the real object's H(x, x'): a constant stiffness, or the real one
/// times a factor.
struct TargetStiffness {
  double constant = 0;  ///< N/m; 0: not this
  double factor = 1;    ///< of the real force at the same depth and rate
};

struct StiffnessModulation {
  HuntCrossley real;  ///< as identified on the object
  double x0 = 0;      ///< m, how far below the surface its contact begins, as identified with it
  Dahl friction;      ///< as identified on its surface
  TargetStiffness target;
  double least_contact = 0.1;  ///< N: a smaller reaction is no contact [chosen: several times a
                               ///< sensor's noise after its filter]
};

struct StiffnessModulationState {
  DahlState friction;
  Packed3 u_n{0, 0, 1};  ///< u_s below
  double f_n = 0;        ///< N, |f_r^n| of the last tick; 0: off contact
};
static_assert(std::is_trivially_copyable_v<StiffnessModulation> &&
              std::is_trivially_copyable_v<StiffnessModulationState>);

/// One tick's answer. All in the frame of the arguments.
struct Modulated {
  bool contact = false;
  Vec3 f_d = Vec3::Zero();   ///< N, of the device on the tool
  Vec3 u_n = Vec3::UnitZ();  ///< estimated outward normal
  double x = 0;              ///< m, estimated depth
  double f_n = 0;            ///< N, of the real object along u_n
  Vec3 slid = Vec3::Zero();  ///< m, how far the tip slid over the surface in this tick
};

/// Without a model of the object's shape, from the reaction f_r on the tool (N; tool weight and
/// dynamics taken off) and the tip's motion dp in this tick (m):
///     f_r^t = -drag (Dahl, in the plane across u_s)
///     u_n = (f_r - f_r^t) / |f_r - f_r^t|,   f_n = |f_r - f_r^t|           (10.6)
///     x = x0 + H^-1(f_n, x'),   x' = -dp.u_n / dt
///     f_d = (k~ x - f_n) u_n                                                (10.4)
/// by the part of dp that slides over the normal u_s, which follows u_n only while it slides
/// (within a tenth of a millimetre of it): dp_t (1 - min(1, 0.05 |dp_n| / |dp_t|)), what goes
/// within 3 degrees of the normal being taken for pressing. With the last u_n for u_s and all of
/// dp_t, as the source has it, a normal that errs by a degree makes friction out of pressing, and
/// that makes it err more, up to the whole friction angle, wherever sigma is above the normal
/// stiffness: in every soft thing. Friction stays the real one. Zero where the reaction is below
/// `least_contact` or no number. Advances `state`. No allocation, no exception.
Modulated modulateStiffness(const StiffnessModulation& law, const Vec3& f_r, const Vec3& dp,
                            double dt, StiffnessModulationState* state) noexcept;

}  // namespace palpa::haptics

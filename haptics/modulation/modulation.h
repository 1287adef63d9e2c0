#pragma once

#include <array>
#include <type_traits>

#include "anatomy/geometry/pose.h"
#include "haptics/materials/force_laws.h"

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
  /// N: a smaller reaction is no contact [chosen: several times a sensor's noise after its filter]
  double least_contact = 0.1;
};

struct StiffnessModulationState {
  DahlState friction;
  Packed3 u_n{0, 0, 1};  ///< u_s below
  double f_n = 0;        ///< N, |f_r^n| of the last tick; 0: off contact
  double told_N = 0;     ///< largest f_n that u_s was told by
};
static_assert(std::is_trivially_copyable_v<StiffnessModulation> &&
              std::is_trivially_copyable_v<StiffnessModulationState>);

/// One tick's answer. All in the frame of the arguments.
struct Modulated {
  bool contact = false;
  Vec3 f_d = Vec3::Zero();    ///< N, of the device on the tool
  Vec3 u_n = Vec3::UnitZ();   ///< estimated outward normal
  double x = 0;               ///< m, estimated depth
  double f_n = 0;             ///< N, of the real object along u_n
  Vec3 slid = Vec3::Zero();   ///< m, how far the tip slid over the surface in this tick
  Vec3 f_rub = Vec3::Zero();  ///< N, the part of f_d that changes the friction
};

/// The part of a tip's motion dp, m, that slides over a surface of unit normal u, where it presses
/// with f N; `modulateStiffness` says which part that is.
Vec3 slidOver(const Vec3& dp, const Vec3& u, double f) noexcept;

/// Without a model of the object's shape, from the reaction f_r on the tool (N; tool weight and
/// dynamics taken off) and the tip's motion dp in this tick (m):
///     f_r^t = -drag (Dahl, in the plane across u_s)
///     u_n = (f_r - f_r^t) / |f_r - f_r^t|,   f_n = |f_r - f_r^t|           (10.6)
///     x = x0 + H^-1(f_n, x'),   x' = -dp.u_n / dt
///     f_d = (k~ x - f_n) u_n                                                (10.4)
/// by the part of dp that slides over the normal u_s: dp_t (1 - min(1, a |dp_n| / |dp_t|)), what
/// goes within a = 0.05 + 0.01 N / f_n of the normal being taken for pressing. u_s follows u_n
/// while it slides (within a tenth of a millimetre of it), and while nothing slides and f_n rises
/// above all before, as it rises: what is hardly touched tells its normal badly. With the last u_n
/// for u_s and all of dp_t, as the source has it, a normal that errs by a degree makes friction out
/// of pressing, and that makes it err more, up to the whole friction angle, wherever sigma is above
/// the normal stiffness: in every soft thing. Friction stays the real one. Zero where the reaction
/// is below `least_contact` or no number. Advances `state`. No allocation, no exception.
Modulated modulateStiffness(const StiffnessModulation& law, const Vec3& f_r, const Vec3& dp,
                            double dt, StiffnessModulationState* state) noexcept;

}  // namespace palpa::haptics

/// A real surface that is felt rougher or smoother than it is: the device adds what the wanted
/// friction has and the real one lacks (Jeon, Choi & Harders 2015, their 10.21).
namespace palpa::haptics {

struct FrictionModulation {
  /// What finds the normal: the real object's law and friction, and the stiffness to be felt
  StiffnessModulation contact;
  Dahl wanted;  ///< of the surface that is to be felt, from a library or identified
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

/// A real object between two tools that is lifted and squeezed, and feels harder, softer, heavier
/// or lighter than it is (Jeon & Harders 2012; weight: Jeon et al. 2011).
namespace palpa::haptics {

struct SqueezeModulation {
  TargetStiffness target;      ///< per contact; a factor is of the real squeezing force
  double weight_factor = 1;    ///< of the real weight
  double least_contact = 0.1;  ///< N, of either reaction
  HuntCrossley real = {};      ///< each side as identified; k = 0: not known
  double x0 = 0;               ///< m, how far below the surface its contact begins, as identified
};

struct SqueezeState {
  double d0 = 0;         ///< m between the tips where both begin to touch; 0: they do not
  double precision = 0;  ///< 1/m^2, inverse variance of d0: the sum over what it is told by
};
static_assert(std::is_trivially_copyable_v<SqueezeModulation> &&
              std::is_trivially_copyable_v<SqueezeState>);

struct Squeezed {
  bool contact = false;
  Vec3 l = Vec3::UnitX();  ///< from the second tip to the first
  double F = 0, x = 0;     ///< N, squeezing force; m, depth at each contact
  std::array<Vec3, 2> f_w{Vec3::Zero(), Vec3::Zero()};  ///< N, each tool's share of the weight
  std::array<Vec3, 2> f_d{Vec3::Zero(), Vec3::Zero()};  ///< N, of the devices on the tools
};

/// From the reactions on both tools (N, tool weights taken off) and their tips (m), no slip and no
/// inertia of the object:
///     l = (p1 - p2) / |p1 - p2|,   u_1 = l,   u_2 = -l         outward
///     F = (f_r1 - f_r2) . l / 2                                (10.12-10.14: equal shares of the
///                                                              weight along l cancel)
///     x = (d0 - |p1 - p2|) / 2                                 (10.15)
///     d0 = mean of |p1 - p2| + 2 (x0 + H^-1(F, 0))             over all ticks since both touch,
///     weighted by 1/((0.025 N / H'(x))^2 + (0.05 x)^2)         the doubts of force and law; where
///                                                              none is known: |p1 - p2| at first
///     f_w* = f_r* - F u_*
///     f_d* = (k~ x - F) u_* + (weight factor - 1) f_w*         (10.11)
/// Which tool is the first does not matter. Zero where one of them does not touch, or for
/// invalid figures. No allocation, no exception.
Squeezed modulateSqueeze(const SqueezeModulation& law, const std::array<Vec3, 2>& f_r,
                         const std::array<Vec3, 2>& p, SqueezeState* state) noexcept;

}  // namespace palpa::haptics

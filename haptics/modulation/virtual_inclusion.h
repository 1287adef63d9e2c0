#pragma once

#include <array>
#include <type_traits>

#include "anatomy/geometry/pose.h"
#include "haptics/materials/force_laws.h"

/// A lump that is not there, felt inside a real object (Jeon, Choi & Harders 2015, their section
/// 5): by one tool or two.
namespace palpa::haptics {

/// What a lump is, wherever it lies.
struct VirtualInclusion {
  double l0 = 0;     ///< m, from its place to the surface where it was identified
  HuntCrossley H_T;  ///< what it adds, against how much the way between tool and lump is shortened
  std::array<HuntCrossley, 3> G;  ///< its bed along x, y, z: what it takes to push it so far
  double falls = 0;               ///< q below; 0: as the source has it
};
static_assert(std::is_trivially_copyable_v<VirtualInclusion>);

struct InclusionState {
  Packed3 d{};                ///< m, how far it is pushed from its place
  std::array<double, 2> l{};  ///< m, of the last tick
};
static_assert(std::is_trivially_copyable_v<InclusionState>);

/// One tool on the object: its tip, the outward normal and the depth there as estimated without the
/// inclusion. A round tip has a radius: what presses on it without friction presses towards its
/// middle.
struct InclusionContact {
  bool touching = false;
  Vec3 p_H = Vec3::Zero(), u_n = Vec3::UnitZ();
  double x = 0, radius = 0;  ///< m
};

struct InclusionAnswer {
  std::array<Vec3, 2> f_T{Vec3::Zero(), Vec3::Zero()};  ///< N, on the tools: what the devices add
  Vec3 d = Vec3::Zero();                                ///< m
  double unbalanced = 0;  ///< N that the solver left between tools and bed
  int iterations = 0;     ///< at most kMostInclusionIterations
};
inline constexpr int kMostInclusionIterations = 24;

/// With the lump resting at p_T0, m; for every tool that touches:
///     p_Hs = p_H + x u_n,   l0* = |p_Hs - p_T0|       where the undeformed surface was, updated
///                                                     every tick
///     l = (l0 / l0*) (l0* - |p_H - p_T|),   p_T = p_T0 + d                 (10.19)
///     f_T = (l0 / l0*)^q H_T(l, l') (p_C - p_T) / |p_C - p_T|,  zero for l <= 0       (10.18)
///     p_C = p_H + radius u_n      where the source has p_H: its tip was small
/// and for the lump, i = x, y, z:
///     sgn(d_i) G_i(|d_i|, sgn(d_i) d_i') = - sum f_T,i                     (10.20)
/// Rates are backward differences over dt, so all is solved together in every tick: an explicit
/// rate is unstable from b d / (m k dt) = 0.67 on. Newton's method on the balance of the lump,
/// steps halved until they help, bounded. Starts from the last tick. Invalid figures give
/// zero and forget. No allocation, no exception.
InclusionAnswer feelInclusion(const VirtualInclusion& lump, const Vec3& p_T0,
                              const std::array<InclusionContact, 2>& tools, double dt,
                              InclusionState* state) noexcept;

/// What the lump adds to the friction, N on the tool: it makes the surface press harder, and a
/// surface rubs as it is pressed. `f_t`: the real friction on the tool, `f_n` the real normal
/// force, `u_n` its way; the sensed friction grows as the normal force does (the source leaves this
/// out, which errs by mu times what the lump adds).
///     f_t (f_T . u_n) / f_n
Vec3 rubbedByLump(const Vec3& f_T, const Vec3& f_t, double f_n, const Vec3& u_n) noexcept;

}  // namespace palpa::haptics

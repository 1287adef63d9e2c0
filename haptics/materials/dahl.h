#pragma once

#include <type_traits>

#include "anatomy/geometry/pose.h"

namespace palpa::haptics {

/// Friction of a surface under a tool that slides over it: Dahl's model (1968) in the tangent
/// plane, with a viscous term (after Mahvash & Okamura 2006).
///     F+ = F_c s + (F - F_c s) exp(-sigma |dp| / F_c),   s = dp / |dp|,   F_c = mu f_n;   |F| <=
///     F_c;   0 off contact
/// dp: motion of the contact point along the tangent plane. Exact for straight motion at any step.
/// F is the force with which the tool drags the surface: the surface's on the tool is -(F + B v).
struct Dahl {
  double mu = 0;     ///< of Coulomb friction
  double sigma = 0;  ///< N/m, stiffness before it slides
  double B = 0;      ///< N s/m
};

struct DahlState {
  Packed3 F{};  ///< N
};
static_assert(std::is_trivially_copyable_v<Dahl> && std::is_trivially_copyable_v<DahlState>);

/// The force F + B v with which the tool drags the surface, N. `dp`: of this tick, m, its part
/// along `n` is left out; `n`: unit normal; f_n <= 0: no contact. Where the normal has turned since
/// the last tick, F turns with the plane and keeps its size.
Vec3 dragOf(const Dahl& law, const Vec3& dp, const Vec3& n, double f_n, double dt,
            DahlState* state) noexcept;

}  // namespace palpa::haptics

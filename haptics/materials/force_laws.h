#pragma once

#include <type_traits>

#include "anatomy/geometry/pose.h"

namespace palpa::haptics {

/// Normal force of a soft thing against how deep it is pressed (Hunt & Crossley 1975): x depth, m,
/// along the inward normal; x' its rate, m/s.
///     f = x^m max(k + b x', k / 10)        k in N/m^m, b in N s/m^(m+1); 1 <= m <= 2 for surfaces
/// The bound keeps a thing that is left fast from pulling, and makes the law invertible. No force
/// at x <= 0.
struct HuntCrossley {
  double k = 0, b = 0, m = 1;
};
static_assert(std::is_trivially_copyable_v<HuntCrossley>);

double forceOf(const HuntCrossley& law, double x, double rate) noexcept;  ///< N
double depthOf(const HuntCrossley& law, double f,
               double rate) noexcept;  ///< m; the inverse: x of forceOf(x) = f; 0 for f <= 0
double stiffnessOf(const HuntCrossley& law, double x, double rate) noexcept;  ///< df/dx, N/m

/// Friction of a surface under a tool that slides over it: Dahl's model (1968) in the tangent
/// plane, with a viscous term (after Mahvash & Okamura 2006).
///     F+ = F_c s + (F - F_c s) exp(-sigma |dp| / F_c)
///     s = dp / |dp|,   F_c = mu f_n,   |F| <= F_c;   0 off contact
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

/// How the elastic force of a held tissue falls (Prony series, normalised):
///     G(t) = 1 - sum g_i + sum g_i exp(-t / tau_i),   f(t) = integral of G(t - s) dF_e(s)
/// F_e: the elastic force, N; g_i: shares, sum below 1; tau_i in seconds. All g 0: no relaxation.
struct Relaxation {
  static constexpr int kTerms = 2;
  double g[kTerms]{};
  double tau[kTerms]{1, 1};
};

/// What a contact remembers of it. Zero at first touch.
struct RelaxationState {
  double held[Relaxation::kTerms]{};  ///< N, of each term
  double elastic = 0;                 ///< F_e of the last tick, N
};
static_assert(std::is_trivially_copyable_v<Relaxation> &&
              std::is_trivially_copyable_v<RelaxationState>);

/// Force after relaxation. Exact for an F_e that grows evenly within dt (Taylor, Pister, Goudreau
/// 1970):
///     h_i <- exp(-dt/tau_i) h_i + g_i (tau_i/dt) (1 - exp(-dt/tau_i)) (F_e - F_e last)
/// so it is stable for any step. `elastic` <= 0 forgets everything: the contact is over.
double relaxed(const Relaxation& law, RelaxationState& state, double elastic, double dt) noexcept;

}  // namespace palpa::haptics

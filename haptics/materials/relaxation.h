#pragma once

#include <type_traits>

namespace palpa::haptics {

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

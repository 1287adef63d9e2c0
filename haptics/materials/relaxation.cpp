#include "haptics/materials/relaxation.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {

double relaxed(const Relaxation& law, RelaxationState& state, double elastic, double dt) noexcept {
  if (elastic <= 0) {
    state = RelaxationState{};
    return 0;
  }
  const double grown = elastic - state.elastic;
  double force = elastic;
  for (int i = 0; i < Relaxation::kTerms; ++i) {
    if (law.g[i] == 0) continue;
    const double a = dt > 0 ? dt / law.tau[i] : 0.0;
    const double kept = std::exp(-a);
    const double share = a > 0 ? -std::expm1(-a) / a : 1.0;
    state.held[i] = kept * state.held[i] + law.g[i] * share * grown;
    force -= law.g[i] * elastic - state.held[i];
  }
  state.elastic = elastic;
  return std::max(force,
                  0.0);  // drawn back fast, the tissue lags behind the tool: it does not pull
}

}  // namespace palpa::haptics

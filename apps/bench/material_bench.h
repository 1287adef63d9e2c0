#pragma once

namespace palpa::bench {

struct MaterialBenchOptions {
  bool quick = false;  ///< without noise only, and three of the mock-ups
};

/// How true haptic augmented reality is on simulated phantoms, whose forces come from finite
/// elements: one JSON object a line on standard output. Throws Error.
void benchMaterial(const MaterialBenchOptions& options);

}  // namespace palpa::bench

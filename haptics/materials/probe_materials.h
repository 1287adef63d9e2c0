#pragma once

#include <type_traits>

#include "haptics/materials/relaxation.h"

namespace palpa::haptics {

/// A palpation probe on soft tissue. The tip is a ball; radius 0: a point.
struct ProbeMaterials {
  double radius = 0;       ///< m
  double stiffness = 500;  ///< k, N/m
  double damping = 0;      ///< b, N s/m
  double friction = 0;     ///< mu, Coulomb
  double shear = 300;      ///< N/m, before the tip slides
  Relaxation relaxation;   ///< of the elastic part
};
static_assert(std::is_trivially_copyable_v<ProbeMaterials>);

}  // namespace palpa::haptics

#pragma once

#include "anatomy/patient.h"

namespace palpa::scene {

enum class Plane { frontal, sagittal, axial };

/// How a parallel view looks at the patient: directions of the eye, and the letters at the edges
/// (patient's Right, Left, Superior, Inferior, Anterior, Posterior). The side view looks from the
/// side that is punctured.
struct Aspect {
  const char* caption;
  Vec3 ahead_A, up_A;
  const char *left, *right, *top, *bottom;
};
Aspect aspectOf(Plane plane, anatomy::Side side);

/// Of a thing that lies on a table (anatomy/phantom_block.h), for who sits before it: from above,
/// from the front, from the right; up is up.
Aspect aspectOnTable(Plane plane);

}  // namespace palpa::scene

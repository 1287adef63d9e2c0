#pragma once

#include <vector>

#include "anatomy/parametric/build.h"
#include "anatomy/shapes/field.h"

namespace palpa::anatomy {

/// A rib of the +l side with its cartilage (frame B, mm).
struct Rib {
  TubeField tube;  ///< round stand-in of both, for shapes that keep away from them
  TriangleMesh bone, cartilage;
};

/// The first seven ribs (four of a bust), from the sternum's border round to the spine; the first
/// lies lower under a wide vein.
std::vector<Rib> makeRibs(const Build& build, double vein_radius_mm);

}  // namespace palpa::anatomy

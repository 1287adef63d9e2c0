#pragma once

#include "anatomy/parametric/body_surface.h"

namespace palpa::anatomy {

/// Muscles of the +l side that the needle may meet (frame B, mm), closed.

/// A fan under the skin and fat, from the clavicle's medial half and the sternum to the upper arm;
/// between its rounded borders as thick as the muscle layer.
TriangleMesh makePectoralisMajor(const BodySurface& skin, const Clavicle& clavicle);

/// From the third to fifth rib near their cartilages to the coracoid.
TriangleMesh makePectoralisMinor(const BodySurface& skin, const Clavicle& clavicle,
                                 const Build& build);

/// From the first rib's cartilage to the clavicle's lower side.
TriangleMesh makeSubclavius(const BodySurface& skin, const Clavicle& clavicle);

}  // namespace palpa::anatomy

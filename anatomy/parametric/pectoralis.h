#pragma once

#include "anatomy/parametric/body_surface.h"

namespace palpa::anatomy {

/// Pectoralis major as a closed fan under the skin and fat, from the clavicle's medial half and the
/// sternum to the upper arm; between its rounded borders as thick as the muscle layer. Frame B, mm.
TriangleMesh makePectoralis(const BodySurface& skin, const Clavicle& clavicle);

}  // namespace palpa::anatomy

#pragma once

#include "anatomy/volume/thorax_bones.h"

namespace palpa::anatomy {

/// Closed surface of a mask's largest piece, in S, metres: surface nets on the blurred signed distance moved outward by `outward`. Where
/// the mask reaches the volume's border it is closed by a flat face `beyond` outside of it. It keeps off `others` (may be
/// empty) by 0.5 mm. An empty mask gives an empty mesh.
TriangleMesh labelSurface(const Scan& scan, const Mask& mask, const Mask& others, double smoothing, double cell, double outward = 0, double beyond = 0);

}  // namespace palpa::anatomy

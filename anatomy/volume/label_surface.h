#pragma once

#include "anatomy/volume/thorax_bones.h"

namespace palpa::anatomy {

/// Closed surface of a mask's largest piece, in S, metres: surface nets on the blurred signed
/// distance moved outward by `outward`; one piece, not folded. Where the mask reaches the volume's
/// border it is closed by a flat face `beyond` outside of it. An empty mask gives an empty mesh.
/// `occupied` (may be null) holds the least of the fields of the surfaces made before, a value a
/// voxel: this one keeps 1.1 mm off them, and its own field is added. (Between the meshes of the
/// LIDC sample 0.6 mm and more are left: `palpa patient info`.)
TriangleMesh labelSurface(const Scan& scan, const Mask& mask, Values* occupied, double smoothing,
                          double cell, double outward = 0, double beyond = 0);

/// An `occupied` of nothing.
Values nothingOccupied(const Scan& scan);

}  // namespace palpa::anatomy

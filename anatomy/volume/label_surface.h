#pragma once

#include "anatomy/patient.h"
#include "anatomy/volume/segmentation.h"

namespace palpa::anatomy {

/// The piece (joined by triangles) that encloses most; bubbles and slivers go.
void keepLargestPiece(TriangleMesh* mesh);

/// Moves vertices whose triangles fold back over an edge (normals more than 101 degrees apart) or
/// have no area to the mean of their neighbours, then more and more about them, until none are left
/// or 40 rounds are over. Closest-point signs are wrong at folds. Returns how many folded edges
/// remain. Needs a closed mesh; normals are not renewed.
int unfold(TriangleMesh* mesh);

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

#pragma once

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// The piece (joined by triangles) that encloses most; bubbles and slivers go.
void keepLargestPiece(TriangleMesh* mesh);

/// Moves vertices whose triangles fold back over an edge (normals more than 101 degrees apart) or
/// have no area to the mean of their neighbours, then more and more about them, until none are left
/// or 40 rounds are over. Closest-point signs are wrong at folds. Returns how many folded edges
/// remain. Needs a closed mesh; normals are not renewed.
int unfold(TriangleMesh* mesh);

}  // namespace palpa::anatomy

#pragma once

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// Area-weighted vertex normals from the triangles.
void computeNormals(TriangleMesh* mesh);

/// Turns every triangle round.
void flip(TriangleMesh* mesh);

/// The mirror image across x = 0, still facing outward.
TriangleMesh mirroredMesh(TriangleMesh mesh);

/// Volume enclosed by a closed mesh; positive when the triangles face outward.
double signedVolume(const TriangleMesh& mesh);

/// Every edge is shared by exactly two triangles that run along it in opposite directions.
bool isClosed(const TriangleMesh& mesh);

}  // namespace palpa::anatomy

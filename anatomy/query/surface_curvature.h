#pragma once

#include <vector>

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// How a surface's normal turns: dn = S dx for a step dx in the tangent plane; symmetric, S n = 0.
/// 1/m. Convex is positive: a sphere of radius R has S = (I - n n^T) / R.
using ShapeOperator = Mat3;

/// One a vertex, by Rusinkiewicz (2004): in every triangle the 2 x 2 operator that best turns its
/// edges into the differences of its corners' normals (three edges, two components each, least
/// squares), averaged over the triangles round a vertex by area and put into its tangent plane. It
/// is as good as the normals: with exact ones the error falls with the edge, squared where the
/// triangles are regular. `tests/anatomy/surface_curvature_test.cpp` has the figures.
std::vector<ShapeOperator> vertexShapeOperators(const TriangleMesh& mesh);

struct PrincipalCurvatures {
  double k1 = 0, k2 = 0;  ///< 1/m, k1 >= k2
  Vec3 d1 = Vec3::Zero(),
       d2 = Vec3::Zero();  ///< unit, in the tangent plane; n, d1, d2 right-handed
};
/// Eigenvalues of S in the plane across the unit normal n, in closed form.
PrincipalCurvatures principalCurvatures(const ShapeOperator& S, const Vec3& n);

}  // namespace palpa::anatomy

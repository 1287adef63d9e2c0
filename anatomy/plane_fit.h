#pragma once

#include "anatomy/triangle_tree.h"

namespace palpa::anatomy {

struct PlaneFit {
  Vec3 n = Vec3::UnitZ();  ///< unit, on the side of the normal that was given
  double rms = 0;          ///< weighted, of the vertices' distances to the plane
};

/// Plane of least weighted variance through the vertices within `reach` of `centre`, weights (1 -
/// d^2/reach^2)^2; with fewer than three of them `normal` and no residual. Two walks over the
/// vertices, no allocation.
PlaneFit fitPlaneTo(const TriangleTree& tree, const Vec3& centre, const Vec3& normal, double reach);

}  // namespace palpa::anatomy

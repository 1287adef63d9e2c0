#pragma once

#include "anatomy/query/triangle_tree.h"

namespace palpa::anatomy {

struct PlaneFit {
  Vec3 n = Vec3::UnitZ();  ///< unit, on the side of the normal that was given
  double rms = 0;          ///< weighted, of the vertices' distances to the plane
};

/// Plane of least weighted variance through the vertices within `reach` of `centre`, weights (1 -
/// d^2/reach^2)^2; with fewer than three of them `normal` and no residual. Two walks over the
/// vertices, no allocation.
PlaneFit fitPlaneTo(const TriangleTree& tree, const Vec3& centre, const Vec3& normal, double reach);

struct TubeFit {
  bool ok = false;
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();  ///< ends of the axis
  double radius = 0;
  double rms = 0;  ///< weighted, of the vertices' distances to the cylinder
};

/// Cylinder through the vertices within `reach` of `centre`, weighted by (1 - d^2/reach^2)^2, so
/// that the fit moves smoothly with the centre. The axis is the direction of least variance of the
/// normals (those of a tube are perpendicular to it); the circle solves |q|^2 = 2 c.q + e in the
/// plane across, by linear least squares (Kasa 1976), radius^2 = e + |c|^2. The ends are the
/// outermost of the vertices used. Not ok with fewer than 8 vertices or where no circle fits.
/// Three walks over those vertices, nothing kept: no allocation, and the cost knows only how many
/// are near.
TubeFit fitTubeTo(const TriangleTree& tree, const Vec3& centre, double reach);

}  // namespace palpa::anatomy

#pragma once

#include <Eigen/Core>
#include <vector>

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// A plane with axes of its own: p_A = origin_A + u across_A + v up_A. Metres.
struct SectionPlane {
  Vec3 origin_A = Vec3::Zero();
  Vec3 across_A = Vec3::UnitX(), up_A = Vec3::UnitY();  ///< unit, perpendicular

  Vec3 normal_A() const { return across_A.cross(up_A); }
  /// (u, v) of the foot of a point in the plane.
  Eigen::Vector2d at(const Vec3& p_A) const {
    const Vec3 d = p_A - origin_A;
    return {d.dot(across_A), d.dot(up_A)};
  }
  /// How far a point lies from the plane, along its normal.
  double offset(const Vec3& p_A) const { return (p_A - origin_A).dot(normal_A()); }
};

/// A line in which a plane cuts an organ's surface: (u, v), metres, the organ on its left as the
/// plane's normal sees it.
struct SectionLine {
  Organ organ = Organ::none;
  bool closed = false;  ///< the last point leads to the first; of a closed surface every line is
  std::vector<Eigen::Vector2d> points;
};

/// Every line in which the plane cuts this surface, each edge of which two triangles share at most;
/// exact for its triangles. Points of the mesh at the same place are one; a corner in the plane
/// counts as above it.
std::vector<SectionLine> sectionOf(const OrganSurface& organ, const SectionPlane& plane);

}  // namespace palpa::anatomy

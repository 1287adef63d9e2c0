#pragma once

#include <array>

#include "anatomy/geometry/pose.h"

namespace palpa::anatomy {

/// Closest point of triangle abc to p as barycentric weights (Ericson, Real-Time Collision
/// Detection, 5.1.5: by Voronoi regions).
Vec3 closestWeights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Segment against triangle: where they are nearest. Zero where they meet.
struct SegmentToTriangle {
  double squared;  ///< of the distance
  double s;        ///< 0..1 along the segment
  Vec3 weights;    ///< barycentric
};
/// Exact: the least of crossing (0), both ends against the face, and the segment against the three
/// edges (Ericson 5.1.9, 5.1.10). A segment of no length is a point.
SegmentToTriangle segmentToTriangle(const Vec3& a, const Vec3& b,
                                    const std::array<Vec3, 3>& triangle);

}  // namespace palpa::anatomy

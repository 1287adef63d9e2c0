#pragma once

#include <memory>
#include <vector>

#include "anatomy/patient.h"

namespace palpa::anatomy {

struct SurfacePoint {
  Vec3 p_A;
  Vec3 n_A;         ///< outward unit normal, interpolated
  double distance;  ///< signed: negative inside
};

struct RayHit {
  double s;  ///< distance along the ray from its start, metres
  Vec3 n_A;  ///< outward unit normal of the organ there
  Organ organ;
  int surface;  ///< index into Patient::organs
  bool entering;
};

/// Exact answers about a patient's meshes. Immutable after construction; all calls are const and
/// may run in several threads at once.
class SurfaceQuery {
 public:
  explicit SurfaceQuery(const Patient& patient);
  ~SurfaceQuery();
  SurfaceQuery(SurfaceQuery&&) noexcept;
  SurfaceQuery& operator=(SurfaceQuery&&) noexcept;

  /// Closest point on the given surface (index into Patient::organs).
  SurfacePoint closest(int surface, const Vec3& p_A) const;
  /// The same on the surface rounded by its vertices' normals (`roundedPoint`): the foot of `p` on the facet,
  /// moved onto the curved triangle over it. Near a surface, not a closest point to the last bit.
  SurfacePoint rounded(int surface, const Vec3& p_A) const;
  /// All crossings of the segment start + s * direction (unit), 0 <= s <= length, in order of s.
  std::vector<RayHit> cast(const Vec3& start_A, const Vec3& direction_A, double length) const;
  /// Cylinder that fits a tube-like surface near a point: axis from the normals' covariance, circle
  /// by least squares, cut to the vertices within `reach`. Empty when nothing is that close.
  struct Tube {
    Vec3 a_A, b_A;
    double radius;
    double rms;
  };
  bool fitTube(int surface, const Vec3& p_A, double reach, Tube* tube) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpa::anatomy

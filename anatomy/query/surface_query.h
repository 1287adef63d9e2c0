#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "anatomy/geometry/local_geometry.h"
#include "anatomy/patient.h"
#include "anatomy/query/surface_curvature.h"

namespace palpa::anatomy {

struct SurfacePoint {
  Vec3 p_A;
  Vec3 n_A;         ///< outward unit normal, interpolated
  double distance;  ///< signed: negative inside
};

struct CurvedPoint : SurfacePoint {
  PrincipalCurvatures curvature;
};

struct RayHit {
  double s;  ///< distance along the ray from its start, metres
  Vec3 n_A;  ///< outward unit normal of the organ there
  Organ organ;
  int surface;  ///< index into Patient::organs
  bool entering;
};

/// A stretch of the needle inside one organ; metres from the needle's start.
struct NeedlePass {
  Organ organ;
  int surface;                ///< index into Patient::organs
  double enter;               ///< 0 where the needle starts inside
  double leave;               ///< its whole length where the tip is inside
  Vec3 n_enter_A, n_leave_A;  ///< outward unit normals there; zero where there is no crossing
  bool starts_inside, ends_inside;

  double length() const { return leave - enter; }
};

/// Everything that a straight needle passes, in the order in which it enters (of several at once,
/// the first surface first): layer by layer from the start on. Fixed room: what does not fit is
/// left out and `lost` is set.
struct NeedlePasses {
  static constexpr int kMost = 64;
  std::array<NeedlePass, kMost> pass;
  int count = 0;
  double length = 0;  ///< of the needle
  bool lost = false;

  const NeedlePass* begin() const { return pass.data(); }
  const NeedlePass* end() const { return pass.data() + count; }
  /// How far the tip is beyond the needle's first entry into `organ`; 0 if it does not meet it.
  double depth(Organ organ) const;
};

/// How far a tool passes from an organ.
struct NearMiss {
  Organ organ;
  int surface;
  double tip;  ///< signed distance of the tip, metres; negative inside
  /// Of the whole segment: 0 where it runs through the surface, negative where it is all inside
  double shaft;
  double shaft_s;       ///< where on the shaft: 0 at the tip, 1 at the other end
  Vec3 tip_A, shaft_A;  ///< the surface's points nearest to the tip, to the shaft
};

/// Exact answers about a patient's meshes. Immutable after construction; all calls are const and
/// may run in several threads at once. Only `cast` that fills a vector allocates.
class SurfaceQuery {
 public:
  /// `ready` takes the vertices' shape operators beforehand; without them `curved` throws Error.
  enum class Curvature { ready, left_out };
  explicit SurfaceQuery(const Patient& patient, Curvature curvature = Curvature::ready);
  ~SurfaceQuery();
  SurfaceQuery(SurfaceQuery&&) noexcept;
  SurfaceQuery& operator=(SurfaceQuery&&) noexcept;

  int surfaces() const;

  /// Closest point on the given surface (index into Patient::organs).
  SurfacePoint closest(int surface, const Vec3& p_A) const;
  /// The same with principal curvatures, interpolated between the vertices'
  /// (`vertexShapeOperators`).
  CurvedPoint curved(int surface, const Vec3& p_A) const;
  bool inside(int surface, const Vec3& p_A) const { return closest(surface, p_A).distance < 0; }
  /// The same on the surface rounded by its vertices' normals (`roundedPoint`): the foot of `p` on
  /// the facet, moved onto the curved triangle over it. Near a surface, not a closest point to the
  /// last bit.
  SurfacePoint rounded(int surface, const Vec3& p_A) const;

  /// All crossings of the segment start + s * direction (unit), 0 <= s <= length, in order of s.
  std::vector<RayHit> cast(const Vec3& start_A, const Vec3& direction_A, double length) const;
  /// Every organ that the needle from `start` to `tip` passes. Surfaces are taken as closed.
  void needle(const Vec3& start_A, const Vec3& tip_A, NeedlePasses* passes) const;

  /// Where a segment comes nearest to the surface: `distance` is exact, 0 where it runs through it,
  /// negative where all of it is inside. `s`, if asked for: 0 at a, 1 at b.
  SurfacePoint nearSegment(int surface, const Vec3& a_A, const Vec3& b_A,
                           double* s = nullptr) const;
  /// Tip and shaft (tip to `back`) against every surface, in the order of Patient::organs. Returns
  /// how many were written: the smaller of surfaces() and the room.
  int nearMisses(const Vec3& tip_A, const Vec3& back_A, std::span<NearMiss> misses) const;

  /// Plane through the surface's nearest point that fits its vertices within `reach`, weighted by
  /// (1 - d^2/reach^2)^2: least variance across. With fewer than three of them, the nearest point's
  /// normal. `rms` is the weighted one of the vertices to the plane. `n_A` outward.
  struct TangentPlane {
    Vec3 p_A, n_A;
    double rms;
  };
  TangentPlane tangentPlane(int surface, const Vec3& p_A, double reach) const;

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

/// The surface point nearest to the segment a–b (least signed distance): the best of samples 8 mm
/// apart, then alternating projection between segment and surface.
SurfacePoint nearestToSegment(const SurfaceQuery& query, int surface, const Vec3& a_A,
                              const Vec3& b_A);

/// Cubic height over the tangent plane at the surface's point nearest to `near_A`, by least squares
/// through 37 points of the rounded surface within `reach` (a centre and three rings), the inner
/// ones weighing more. With fewer than 20 usable points (a rim, a fold), or a reach of 0, it is the
/// tangent plane. Metres, frame A. A few closest-point queries a millimetre: 0.1 ms, logarithmic in
/// the mesh.
SurfacePatch fitSurfacePatch(const SurfaceQuery& query, int surface, const Vec3& near_A,
                             double reach);

}  // namespace palpa::anatomy

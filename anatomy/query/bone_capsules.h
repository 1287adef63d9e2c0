#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "anatomy/patient.h"
#include "anatomy/query/surface_query.h"

namespace palpa::anatomy {

/// All points within `radius` of the segment a-b.
struct Rod {
  Vec3 a, b;
  double radius;
};

/// Of p from the rod's surface, negative inside. `foot`, if asked for: the segment's point nearest
/// to p.
double distanceTo(const Rod& rod, const Vec3& p, Vec3* foot = nullptr);

struct SurfaceSample {
  Vec3 p, n;  ///< n: outward, unit
};

/// Radius of the largest ball inside the surface that touches it at p with the outward normal n, at
/// most `most`: no sample lies deeper than `give` in it. r = min over q of ((p - q)^2 - give^2) /
/// (2 (n . (p - q) - give)).
double inscribedRadius(const std::vector<SurfaceSample>& samples, const Vec3& p, const Vec3& n,
                       double give, double most);

/// The rod about the inscribed ball's centre, along `u` as far as no sample lies deeper than `give`
/// in it, at most `half` each way.
Rod inscribedRod(const std::vector<SurfaceSample>& samples, const Vec3& p, const Vec3& n,
                 const Vec3& u, double give, double most, double half);

/// Direction along which the samples within `reach` of p are least curved: of least variance of
/// their normals.
Vec3 alongSurface(const std::vector<SurfaceSample>& samples, const Vec3& p, double reach);

struct RodFit {
  std::vector<Rod> rods;
  double rms = 0;  ///< of the samples' distances to the union, metres
};

/// Rods whose union fits the samples of a closed surface: one more at a time, inscribed where the
/// union misses most, then all of them moved to the least sum of squares of the samples' distances
/// to the union (Levenberg 1944, Marquardt 1963; a sample counts for the rod nearest to it, so that
/// every rod has normal equations of its own, 7 by 7). Ends at `good_rms` or with `most` rods. Same
/// samples, same bits.
RodFit fitRods(const std::vector<SurfaceSample>& samples, double good_rms, int most);

/// What stands for a bone in the snapshots: rods fitted to its whole surface once (`fitRods`, at
/// most 48, to 0.5 mm rms), of which a snapshot takes those near the touched place. Immutable;
/// threads may share it. Frame A, metres. Same mesh, same bits. To make one takes 2 to 25 ms.
class BoneCapsules {
 public:
  explicit BoneCapsules(const TriangleMesh& mesh);

  /// At most `most` capsules for a snapshot in which the tool is nearest to the surface's point
  /// `nearest`. The first one touches the surface there with its normal and lies within the bone
  /// (inscribed, to 0.3 mm), so that distance and direction of a force are exact where touched. The
  /// others are rods within 26 mm, the nearest first, moved so that none covers that place; those
  /// that the first one hides are left out. `organ` and `bone` are the caller's. Empty for a bone
  /// that rods miss by more than 1 mm rms (a large plate, a row of vertebrae).
  std::vector<Capsule> near(const SurfacePoint& nearest, int most) const;

  const std::vector<Rod>& rods() const { return rods_; }
  /// Of vertices that the fit did not see, where there are such
  double rms() const { return rms_; }

 private:
  Rod touching(const SurfacePoint& nearest) const;

  std::vector<SurfaceSample> samples_;
  std::vector<Rod> rods_;
  double rms_ = 0;
};

/// Fitted by the first who asks; others wait meanwhile. The mesh must outlive it.
class BoneCapsulesOnDemand {
 public:
  explicit BoneCapsulesOnDemand(const TriangleMesh& mesh) : mesh_(mesh) {}
  const BoneCapsules& get() const {
    std::call_once(once_, [this] { capsules_.emplace(mesh_); });
    return *capsules_;
  }

 private:
  const TriangleMesh& mesh_;
  mutable std::once_flag once_;
  mutable std::optional<BoneCapsules> capsules_;
};

}  // namespace palpa::anatomy

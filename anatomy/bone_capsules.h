#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "anatomy/capsule_fit.h"
#include "anatomy/patient.h"
#include "anatomy/surface_query.h"

namespace palpa::anatomy {

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
  double rms() const {
    return rms_;
  }  ///< of vertices that the fit did not see, where there are such

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

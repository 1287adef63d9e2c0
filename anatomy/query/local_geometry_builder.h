#pragma once

#include <memory>
#include <vector>

#include "anatomy/geometry/local_geometry.h"
#include "anatomy/patient.h"
#include "anatomy/query/bone_capsules.h"
#include "anatomy/query/surface_query.h"

namespace palpa::anatomy {

/// Where a tool is, and where it went in.
struct ToolPlacement {
  Pose X_AT;  ///< tip at the origin of T, needle along +z of T, which points the way it advances
  bool punctured = false;
  Vec3 entry_A = Vec3::Zero();  ///< where the skin was punctured
};

/// Makes the snapshot that the haptic tick reads, around a predicted tool. Pure: same inputs, same
/// bits. Skin as a curved patch round the tip (before puncture) or round `entry`;
/// bones within 40 mm of the tip or the inserted shaft as capsules of which one touches the bone's
/// mesh at its nearest point, with its normal there, and the others follow its shape round it
/// (bone_capsules.h); tissue boundaries along the needle axis from the skin inward to 60 mm beyond
/// the tip (offset planes for skin, fat and muscle, which ends earlier where the axis leaves its
/// mesh at a border; mesh crossings for vessels, lung and bone). A needle that points away from the
/// skin has no boundaries. Threads may share it.
///
/// The capsules' places are shared out so: one for every bone in reach, the nearest bones first;
/// what is left goes round one by one among the bones within 15 mm, until each has all that it has.
class LocalGeometryBuilder {
 public:
  LocalGeometryBuilder(const Patient& patient, const SurfaceQuery& query);

  LocalGeometry build(std::uint64_t number, std::int64_t t_ns, const ToolPlacement& tool,
                      const Pose& X_DA) const;

 private:
  struct Bone {
    int surface;
    Organ organ;
    Eigen::AlignedBox3d box;
    std::unique_ptr<BoneCapsulesOnDemand> capsules;
  };
  struct NearBone {
    const Bone* bone;
    double distance;
    std::vector<Capsule> capsules;
    std::size_t taken;  ///< so many of them go into the snapshot
  };
  struct NeedleAxis {
    Vec3 tip, direction, skin_p, skin_n;
    double s_skin;  ///< from the tip to the skin plane along the direction; negative once inside
  };
  std::vector<NearBone> bonesNear(const ToolPlacement& tool, const NeedleAxis& axis) const;
  void addBones(const ToolPlacement& tool, const NeedleAxis& axis, LocalGeometry* geometry) const;
  void addBoundaries(const NeedleAxis& axis, LocalGeometry* geometry) const;

  const Patient& patient_;
  const SurfaceQuery& query_;
  int skin_;
  std::vector<Bone> bones_;
};

}  // namespace palpa::anatomy

#pragma once

#include "anatomy/geometry/local_geometry.h"

namespace palpa::haptics {

/// Deepest contact of the needle (a thick segment) with one bone capsule.
struct BoneContact {
  double penetration = 0;    ///< m; 0: none
  Vec3 p_D = Vec3::Zero();   ///< on the needle's axis
  Vec3 n_D = Vec3::UnitZ();  ///< from the bone to the needle, unit
  Organ organ = Organ::none;
};

/// Closest points of segments hub–tip and a–b, then penetration = radii - distance.
BoneContact bonePenetration(const Capsule& bone, const Vec3& p_hub, const Vec3& p_tip,
                            double needle_radius) noexcept;

}  // namespace palpa::haptics

#pragma once

#include "anatomy/geometry/local_geometry.h"
#include "haptics/materials/needle_materials.h"

namespace palpa::haptics {

/// Walls already punctured, a bit per Organ.
struct PuncturedWalls {
  std::uint32_t front = 0, back = 0;
};

/// What the tip and the shaft are in, walking the boundaries from the skin inward.
struct TissueWalk {
  Tissue tissue = Tissue::skin;
  double shaft_friction = 0;  ///< N: sum over layers of friction per length x length
  double wall_depth = 0;      ///< m: how far the tip has pushed an intact wall
  Organ wall = Organ::none;
  bool wall_leaving = false;
  PuncturedWalls passed;  ///< walls that are punctured and still around the needle
};

/// `insertion`: length of needle under the skin. A wall that is not in `walls` stops the walk: the
/// tip is still before it, pushing. A wall is forgotten when the tip is 0.3 mm back out of it.
TissueWalk walkTissues(const NeedleMaterials& materials, const LocalGeometry& geometry,
                       const Vec3& p_DT, const Vec3& a_D, double insertion,
                       const PuncturedWalls& walls) noexcept;

}  // namespace palpa::haptics

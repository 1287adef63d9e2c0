#pragma once

#include "haptics/surface/bump_pattern.h"

namespace palpa::haptics {

/// The nearest point found so far of a surface, to a point under it. Lengths in U, in the disc's
/// frame.
struct SurfacePoint {
  double x = 0, y = 0, z = 0;
  double distance2 = 0;  ///< squared
};

/// A disc with hemispheres at the point p = (x, y, z) of their solid, the solid being all that lies
/// under the level z = 0 and in the balls around the bumps. The nearest point of its boundary,
/// where bumps have a part in it, is one of
///   on a hemisphere     from its middle through p, where p is at z >= 0 and in the ball
///   on a footprint      the nearest of its circle at z = 0
///   between two         the nearest of the upper half of the circle where their spheres meet,
///   where p is at z >= 0 a vertex            where two footprints' circles cross at z = 0; where
///   three spheres meet at z > 0
/// each unless another ball holds it; a ball holds what is in it by more than 1e-10. (Under z = 0
/// the nearest of a hemisphere lies on its edge, and of a half circle at its ends.) Replaces `best`
/// by what is nearer. Exact to rounding where the 24 bumps nearest to p decide it: those within 3
/// radii of p, or 5 if so much is covered. What is farther is not looked at; what comes out is free
/// in any case.
void closestOnBumps(const BumpPattern& pattern, double x, double y, double z,
                    SurfacePoint* best) noexcept;

}  // namespace palpa::haptics

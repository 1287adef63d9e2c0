#pragma once

#include "anatomy/geometry/pose.h"

namespace palpa::calibration {

/// The line that is taught on one body, in landmark coordinates L (medial, posterior, cephalad; the
/// same numbers on both sides), metres: in through the skin at the entry point along its normal,
/// then turned toward the middle of the vein.
struct TeachingLine {
  Vec3 entry_L = Vec3::Zero();
  Vec3 inward_L = Vec3::UnitY();  ///< unit, into the body along the skin's normal at the entry
  Vec3 target_L = Vec3::Zero();
};

/// Axes about the way that is left to the vein with the tip `depth` metres under the entry, as
/// columns in L: along the way; across it, inward; across both, cephalad. In these axes what is
/// taught is the same on every body, whatever its build. Throws Error where the way is shorter than
/// 5 mm or runs within 2 degrees of the normal.
Mat3 axesOf(const TeachingLine& line, double depth = 0);

}  // namespace palpa::calibration

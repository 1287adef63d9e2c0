#pragma once

#include "anatomy/query/surface_query.h"

namespace palpa::twin {

/// Where somebody who has studied a patient's pictures would meet the vein, in A, metres: on the
/// vein's axis, as near to `guess_A` (where it lies in the mean anatomy) as a straight needle from
/// `entry_A` comes that stays 2 mm off the clavicle, 3 mm off the pleura before the vein, and meets
/// the vein first [chosen]. Where no such way is seen: the middle of the vein nearest to the guess.
/// Without a vein: the guess.
struct SeenVein {
  Vec3 aim_A;
  double radius;  ///< m, of the vein there; 0 where none is seen
};
SeenVein aimByPictures(const anatomy::Patient& patient, const anatomy::SurfaceQuery& query,
                       const Vec3& entry_A, const Vec3& guess_A);

}  // namespace palpa::twin

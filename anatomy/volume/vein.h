#pragma once

#include <optional>

#include "anatomy/patient.h"
#include "anatomy/volume/scan.h"

namespace palpa::anatomy {

/// A contrast-filled vein as a tube: the cheapest way through bright, even voxels between a seed in
/// the superior vena cava
/// ("vein_svc") and one at the armpit ("vein_axilla"), its radius along the way, and the bright
/// voxels about it.
struct Vein {
  Side side = Side::right;
  std::vector<Vec3> line_S;    ///< axilla to superior vena cava
  std::vector<double> radius;  ///< of the largest ball in the lumen there, metres
  Mask mask;
  Mask contrast;  ///< all dense voxels that are too thick for cortex, with 5 mm about them: no bone
  Seeds seeds;    ///< the two that were used
};

/// Finds what no seed gives: the vena cava as the bright upright tube by the midline, the armpit's
/// end as the dense piece that lies farthest out on the side with more of it. Empty when there is
/// no dense contrast.
std::optional<Vein> findVein(const Scan& scan, const Seeds& seeds);

}  // namespace palpa::anatomy

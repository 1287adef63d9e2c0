#pragma once

#include "anatomy/volume/thorax_bones.h"

namespace palpa::anatomy {

/// Where the skin lies: the body's border, or, in a volume clipped to soft tissue, an estimate:
/// `parts` (bones, vein, lungs) and the soft tissue, closed by 7 mm, so that the hollow below the
/// clavicle stays; the layers over it are still to be added.
Mask skinMask(const Scan& scan, const std::vector<LabelledOrgan>& parts);

}  // namespace palpa::anatomy

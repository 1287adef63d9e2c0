#pragma once

#include <optional>

#include "anatomy/patient.h"
#include "anatomy/volume/scan.h"

namespace palpa::anatomy {

/// One clavicle among all bone. Bones that touch at a low threshold part at a higher one; a
/// clavicle is the piece of the lowest threshold that has its shape: 50 to 190 mm long, a rod of 4
/// to 10 mm rms, in front of the spine and to one side.
struct Clavicle3 {
  Mask mask;  ///< filled: marrow included
  std::vector<Vec3>
      axis_S;         ///< from the sternal end to the acromial end or to where the volume ends
  double length = 0;  ///< along the axis, inside the volume
  bool leaves_volume = false;  ///< at its acromial end
  Vec3 seed_S = Vec3::Zero();  ///< a place in it that finds it again
};

/// Both sides where found. `taken`: voxels of vessels, which are no bone. A seed ("clavicle_right",
/// "clavicle_left") asks for the piece that it lies in or within 8 mm of, of any shape.
struct Clavicles {
  std::optional<Clavicle3> right, left;
};
Clavicles findClavicles(const Scan& scan, const Mask& taken, const Seeds& seeds);

}  // namespace palpa::anatomy

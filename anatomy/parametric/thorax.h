#pragma once

#include "anatomy/parametric/vessels.h"

namespace palpa::anatomy {

/// Bones and pleura of the upper thorax (frame B, mm).
struct Rib {
  TubeField tube;     ///< round stand-in, for shapes that keep away from it
  TriangleMesh mesh;  ///< flat bar, its cartilage thicker at the sternum
};
/// The first three ribs; the first lies lower under a wide vein.
std::vector<Rib> makeRibs(double vein_radius_mm);

/// Manubrium with notch and clavicular facets, and the upper body of the sternum.
TriangleMesh makeSternum(const Clavicle& clavicle);

/// The lung with its dome in the root of the neck, moved back by `shift_y`. It keeps `groove` from
/// the vein's wall (which presses a groove into it), and clear of artery and ribs.
TriangleMesh makeLung(const Vessels& vessels, const std::vector<Rib>& ribs, double shift_y,
                      double groove_mm);

}  // namespace palpa::anatomy

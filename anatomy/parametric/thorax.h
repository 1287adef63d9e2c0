#pragma once

#include "anatomy/parametric/ribs.h"
#include "anatomy/parametric/vessels.h"

namespace palpa::anatomy {

/// What the chest wall holds together (frame B, mm); whole bones, both sides of the midline.

/// Manubrium with notch and clavicular facets, body, xiphoid.
TriangleMesh makeSternum(const Clavicle& clavicle, const Build& build);

/// The upper eight thoracic vertebrae in one: bodies, discs, spinous processes.
TriangleMesh makeSpine(const Build& build);

/// Trachea from the larynx to its fork, and the main bronchi up to the lungs. `handed`: see
/// vessels.h.
std::vector<TubeField> airwayTubes(double handed);
/// It gives way where a wide vessel presses on it.
TriangleMesh makeAirway(const Vessels& vessels);

/// The shoulder blade of the +l side: blade, spine with acromion behind the clavicle's end,
/// coracoid, socket.
TriangleMesh makeScapula(const Clavicle& clavicle, const Build& build);
Vec3 coracoid(const Clavicle& clavicle);  ///< its tip

/// The lung of the +l side (`sign` 1) or of the other with its dome in the root of the neck, moved
/// back by `shift_y`. It keeps `groove` from the veins' walls (which press grooves into it), and
/// clear of arteries, airway and ribs. `part`: of it alone (an open surface), where that is all one
/// needs.
TriangleMesh makeLung(const Vessels& vessels, const std::vector<Rib>& ribs, const Build& build,
                      double sign, double shift_y, double groove_mm,
                      const Eigen::AlignedBox3d& part = {});

}  // namespace palpa::anatomy

#pragma once

#include "anatomy/parametric/body_surface.h"
#include "anatomy/parametric/bones.h"
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

/// Muscles of the +l side that the needle may meet (frame B, mm), closed.

/// A fan under the skin and fat, from the clavicle's medial half and the sternum to the upper arm;
/// between its rounded borders as thick as the muscle layer.
TriangleMesh makePectoralisMajor(const BodySurface& skin, const Clavicle& clavicle);

/// From the third to fifth rib near their cartilages to the coracoid.
TriangleMesh makePectoralisMinor(const BodySurface& skin, const Clavicle& clavicle,
                                 const Build& build);

/// From the first rib's cartilage to the clavicle's lower side.
TriangleMesh makeSubclavius(const BodySurface& skin, const Clavicle& clavicle);

}  // namespace palpa::anatomy

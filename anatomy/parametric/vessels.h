#pragma once

#include "anatomy/parametric/taught_line.h"

namespace palpa::anatomy {

/// The great vessels of the root of the neck (frame B, mm). The vein runs from the axilla under the
/// clavicle through the taught line's target to the confluence with the internal jugular vein and
/// on as brachiocephalic vein; the artery runs behind and above it over the first rib.
struct Vessels {
  TubeField vein, jugular, artery;
  double veinField(const Vec3& p) const;  ///< both veins, joined smoothly

  TriangleMesh veinMesh() const;
  TriangleMesh arteryMesh() const;
};

Vessels makeVessels(const Vec3& vein_target, double vein_radius_mm);

}  // namespace palpa::anatomy

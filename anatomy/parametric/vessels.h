#pragma once

#include "anatomy/parametric/taught_line.h"

namespace palpa::anatomy {

/// The great vessels of both sides (frame B, mm). On either side the vein runs from the axilla past
/// the infraclavicular window and under the clavicle through the taught line's target to the
/// confluence with the internal jugular vein; the brachiocephalic veins join in the superior vena
/// cava on the patient's right. The arteries run behind and above the veins; they come from the
/// aortic arch, on the right by way of the brachiocephalic trunk.
struct Vessels {
  double handed = 1;  ///< 1: the patient's right is at +l, -1: his left
  std::vector<TubeField> veins, arteries;
  double vein_radius = 4.5;  ///< at the target, mm

  double veinField(const Vec3& p) const;  ///< joined smoothly
  double arteryField(const Vec3& p) const;
  double veinsAtLeast(const Vec3& p) const;  ///< no more than veinField there
  /// Where they would touch a bone (signed distance to it), they give way.
  TriangleMesh veinMesh(const Field& bones) const;
  TriangleMesh arteryMesh(const Field& bones, double lowest) const;  ///< cut there
};

/// `window`: the vein's centre at the infraclavicular window; `target`: on the taught line.
Vessels makeVessels(const Vec3& target, const Vec3& window, double vein_radius_mm, Side side);

}  // namespace palpa::anatomy

#pragma once

#include <vector>

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// One cross-section of a swept tube: an ellipse across `tangent`.
struct Section {
  Vec3 centre;
  Vec3 tangent;  ///< unit
  Vec3 up;       ///< unit, across the tangent: direction of `half_up`
  double half_up;
  double half_side;
};

/// Closed tube through the sections with rounded ends (half ellipsoids, `bulge` times the mean
/// half-axis long), `around` vertices a ring.
TriangleMesh sweep(const std::vector<Section>& sections, int around, double bulge);

/// Sections along a chain of points; `up` is made square to the tangent at each.
std::vector<Section> sectionsAlong(const std::vector<Vec3>& centres, const Vec3& up);

}  // namespace palpa::anatomy

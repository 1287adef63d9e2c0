#pragma once

#include "anatomy/shapes/field.h"
#include "anatomy/shapes/sweep.h"

namespace palpa::anatomy {

/// The clavicle in frame B, mm (parametric/frame.h). Its centre line is a plane S: curvature
/// +1/66 mm (convex forward) over the medial part, -1/34 mm over the lateral part, scaled with the
/// length so that the chord is what was asked for; thickness at midshaft as asked for, a bulky
/// sternal and a flat acromial end.
struct Clavicle {
  std::vector<Section> sections;  ///< at equal steps of arc length, sternal end first
  TriangleMesh mesh;
  TubeField tube;  ///< round stand-in of the bone, for shapes that follow it
  Vec3 sternal_end, sternal_end_posterior_superior, acromial_end;
  Vec3 medial_third, middle, lateral_third;  ///< on the centre line, at thirds and half of the arc

  double lowerBorder(double fraction) const;  ///< z of the lower border there
};

Clavicle makeClavicle(double chord_mm, double thickness_mm);

}  // namespace palpa::anatomy

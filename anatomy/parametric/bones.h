#pragma once

#include <vector>

#include "anatomy/parametric/build.h"
#include "anatomy/shapes/implicit_surface.h"
#include "anatomy/shapes/mesh_tools.h"

namespace palpa::anatomy {

/// The clavicle in frame B, mm (build.h). Its centre line is a plane S: curvature
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

/// A rib of the +l side with its cartilage (frame B, mm).
struct Rib {
  TubeField tube;  ///< round stand-in of both, for shapes that keep away from them
  TriangleMesh bone, cartilage;
};

/// The first seven ribs (four of a bust), from the sternum's border round to the spine; the first
/// lies lower under a wide vein.
std::vector<Rib> makeRibs(const Build& build, double vein_radius_mm);

}  // namespace palpa::anatomy

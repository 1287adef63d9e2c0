#pragma once

#include "anatomy/parametric/body_surface.h"
#include "anatomy/query/triangle_tree.h"

namespace palpa::anatomy {

/// What the taught manoeuvre must be (frame B, mm and radians); the same numbers are measured on
/// the finished meshes by checkPatient().
struct TaughtLimits {
  double clearance = 2.2;          ///< needle axis to the clavicle's surface, wanted
  double highest_clearance = 3.4;  ///< where the vein itself keeps the target from the bone
  double vein_to_bone = 0.8;       ///< least tissue between the vein's wall and the clavicle
  double lowest_angle = 0.1745;    ///< 10 degrees to the skin's tangent plane at the entry
  double highest_angle = 0.5061;   ///< 29 degrees: the mesh may show one more, 30 are taught
  double longest = 60;             ///< entry to target
};

struct TaughtLine {
  Vec3 entry, entry_normal;
  Vec3 target, target_skin;  ///< lumen centre, and the skin point nearest to it
  double angle = 0, clearance = 0, length = 0, target_to_bone = 0;
};

/// Finds straight lines from the entry, 1 cm caudal of the clavicle's lower border at the junction
/// of its medial and middle thirds, to a lumen under the skin, behind and below the clavicle.
class TaughtLineSearch {
 public:
  TaughtLineSearch(const BodySurface& skin, const Clavicle& clavicle);

  /// The line that ends `l` from the midline, `centre_depth` under the nearest skin, and passes the
  /// clavicle at the wanted clearance. Throws Error with the limit that it violates.
  TaughtLine find(double l, double centre_depth, double vein_radius,
                  const TaughtLimits& limits = {}) const;

 private:
  TaughtLine lineTo(double l, double z, double centre_depth) const;

  const BodySurface& skin_;
  TriangleTree bone_, front_;
  Vec3 entry_, normal_;
};

}  // namespace palpa::anatomy

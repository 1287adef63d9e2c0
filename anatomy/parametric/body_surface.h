#pragma once

#include "anatomy/parametric/clavicle.h"

namespace palpa::anatomy {

/// The skin of the upper chest as a field in frame B, mm: trunk, neck, shoulder, the clavicle
/// standing out under the skin, the hollows above and below it; flat back, cut at the neck, the
/// arm, the ribs and just past the midline, so that it stands and lies like a training phantom.
class BodySurface {
 public:
  BodySurface(const Clavicle& clavicle, const SoftLayers& layers);

  double operator()(const Vec3& p) const;
  /// y of the skin's front at (l, z).
  double front(double l, double z) const;
  TriangleMesh mesh() const;
  /// Skin, fat and muscle together, mm.
  double layersDepth() const { return skin_ + fat_ + muscle_; }
  double skin() const { return skin_; }
  double fat() const { return fat_; }
  double muscle() const { return muscle_; }

 private:
  double living(const Vec3& p) const;  ///< before the cuts
  double chest(double l, double z) const;

  TubeField clavicle_;
  double skin_, fat_, muscle_;  ///< mm
  double notch_ = 0;            ///< lifts the skin at the notch so that the origin lies on it
};

}  // namespace palpa::anatomy

#pragma once

#include "anatomy/parametric/bones.h"
#include "anatomy/parametric/build.h"

namespace palpa::anatomy {

/// The skin of head and trunk as a field in frame B, mm: chest with its pectoral relief or breasts,
/// hollows above and below the clavicle, which stands out under the skin, neck with the
/// sternomastoids, a mannequin's head, shoulders, upper arms, back with the shoulder blades. Alike
/// on both sides; cut through the upper arms and below the seventh rib, as training phantoms are.
class BodySurface {
 public:
  /// `at_window`: skin, fat and muscle together at the infraclavicular window, mm
  /// (PatientParameters::vein_depth).
  BodySurface(const Clavicle& clavicle, const Build& build, const SoftLayers& layers,
              double at_window);

  double operator()(const Vec3& p) const;
  /// y of the skin's front at (l, z); `under_breast`: of the body without its breasts.
  double front(double l, double z, bool under_breast = false) const;
  /// Unit, outward, of the body without its breasts.
  Vec3 frontNormal(double l, double z) const;
  TriangleMesh mesh() const;

  double soft(
      double a) const;  ///< skin, fat and muscle together at distance a from the midline, mm
  double muscle(double a) const;  ///< of it muscle: as stated, or what shallow layers leave for it
  double skin() const { return skin_; }
  double lower() const { return lower_; }  ///< z of the lower cut
  double upper() const { return upper_; }

 private:
  double bare(const Vec3& p) const;    ///< before the cuts, without breasts
  double living(const Vec3& p) const;  ///< before the cuts
  double cut(double f, const Vec3& p) const;
  double chest(double l, double z) const;
  double back(const Vec3& q) const;
  double neckAndJaw(const Vec3& q) const;
  double shoulder(const Vec3& q) const;
  double breast(const Vec3& q) const;

  TubeField clavicle_, scapula_, arm_;
  Build build_;
  double skin_, fat_, muscle_;  ///< mm
  double at_window_, window_a_;
  Vec3 acromion_;
  double lower_, upper_;
  double notch_ = 0;  ///< lifts the skin at the notch so that the origin lies on it
};

}  // namespace palpa::anatomy

#pragma once

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// Side-free coordinates for what is taught: (medial, posterior, cephalad) about the junction of
/// the clavicle's medial and middle thirds. Medial points along the clavicle's chord to its sternal
/// end; cephalad is the part of +z_A across it; posterior completes the orthogonal triple, pointing
/// to +y_A. On the left side the triple is left-handed: both sides give the same numbers for
/// mirrored motion.
class LandmarkFrame {
 public:
  explicit LandmarkFrame(const Patient& patient);

  Vec3 pointToLandmarks(const Vec3& p_A) const { return basis_.transpose() * (p_A - origin_); }
  Vec3 pointToA(const Vec3& p_L) const { return origin_ + basis_ * p_L; }
  Vec3 vectorToLandmarks(const Vec3& v_A) const { return basis_.transpose() * v_A; }
  Vec3 vectorToA(const Vec3& v_L) const { return basis_ * v_L; }

 private:
  Vec3 origin_;
  Mat3 basis_;  ///< columns: medial, posterior, cephalad in A; determinant +-1
};

}  // namespace palpa::anatomy

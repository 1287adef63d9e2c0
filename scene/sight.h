#pragma once

#include "anatomy/geometry/pose.h"

namespace palpa::scene {

/// Who looks, for what has its size on the screen or faces the eye. A parallel view is one from far
/// away.
struct Sight {
  Pose X_CA = Pose::Identity();
  double focal_px = 1000;  ///< in window pixels
  double before = 0;  ///< metres by which what must never be hidden is drawn nearer to the eye; for
                      ///< parallel views, where nobody sees it

  Vec3 eye() const { return X_CA.inverse().translation(); }
  /// Of C in A, turned so that x is right, y up, z toward the eye.
  Mat3 facing() const {
    const Mat3 R_AC = X_CA.linear().transpose();
    Mat3 R;
    R << R_AC.col(0), -R_AC.col(1), -R_AC.col(2);
    return R;
  }
  double metresPerPixel(const Vec3& p_A) const {
    const double z = (X_CA * p_A).z();
    return (z > 0.05 ? z : 0.05) / focal_px;
  }
};

}  // namespace palpa::scene

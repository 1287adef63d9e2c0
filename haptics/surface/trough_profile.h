#pragma once

namespace palpa::haptics {

/// Cross-section of a rounded trough: a concave arc of radius r_b at the bottom, a convex one of
/// radius r_l at the lip, and between them a straight flank that is tangent to both. With half
/// width w, depth D and R = r_b + r_l that closes exactly for one angle and one length:
///   theta = asin(R / sqrt(w^2 + (R - D)^2)) - atan2(R - D, w),   flank^2 = w^2 + (R - D)^2 - R^2
/// Height and slope are continuous at every joint; the curvature jumps there. Lengths in whatever
/// unit they are given in. Source: the search task of Edmunds and Pai, Perceptually augmented
/// simulator design (IEEE Trans. Haptics, 2012).
class TroughProfile {
 public:
  /// Throws Error where no such arcs fit.
  TroughProfile(double half_width, double depth, double bottom_radius = 2, double lip_radius = 3);

  /// At the distance s from its middle, either side: -depth there, 0 from the half width on.
  double height(double s) const noexcept;
  double slope(double s) const noexcept;  ///< d height / ds; odd in s

  /// The closest point of the whole cross-section, its level surroundings on both sides included,
  /// to (s, z); `s` of either sign. Exact to rounding. Where several are as near, as from an arc's
  /// own middle, one of them.
  struct Point {
    double s = 0, z = 0;
    double distance2 = 0;
  };
  Point closest(double s, double z) const noexcept;
  /// The same of the trough alone, up to the half width.
  Point closestInside(double s, double z) const noexcept;

  double halfWidth() const noexcept { return w_; }
  double depth() const noexcept { return depth_; }
  double angle() const noexcept { return theta_; }  ///< rad, of the flank
  double flank() const noexcept { return flank_; }  ///< its length
  double bottomJoint() const noexcept {
    return s_bottom_;
  }  ///< distance from the middle where the bottom's arc ends
  double lipJoint() const noexcept { return s_lip_; }  ///< and where the lip's begins

 private:
  double w_, depth_, r_b_, r_l_, theta_, flank_, s_bottom_, s_lip_;
  double sin_, cos_;  // of the flank's angle
};

}  // namespace palpa::haptics

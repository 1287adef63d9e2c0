#pragma once

#include <array>
#include <functional>

#include "anatomy/geometry/pose.h"
#include "haptics/surface/bump_pattern.h"

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
  /// Distance from the middle where the bottom's arc ends
  double bottomJoint() const noexcept { return s_bottom_; }
  double lipJoint() const noexcept { return s_lip_; }  ///< and where the lip's begins

 private:
  double w_, depth_, r_b_, r_l_, theta_, flank_, s_bottom_, s_lip_;
  double sin_, cos_;  // of the flank's angle
};

/// The floor of the haptic search task: a square, level at height 0, with three scene elements
/// equally spaced on a circle. A scene element: a textured disc, a groove around it, an untextured
/// pit in its middle. F: origin in the floor's middle, z up; lengths in U throughout this folder.
/// Source: Edmunds and Pai, Perceptually augmented simulator design (IEEE Trans. Haptics, 2012).
struct SearchSpec {
  double side = 240;          ///< of the floor
  double circle = 200.0 / 3;  ///< radius on which the elements' middles lie
  double disc = 25;           ///< radius of the textured disc
  double groove = 30;         ///< radius at which the groove is deepest
  double groove_half_width = 5, groove_depth = 2;
  double pit = 5, pit_depth = 1;             ///< radius, depth
  double bottom_radius = 2, lip_radius = 3;  ///< of the troughs' arcs
  BumpSpec target{2, 7, 5.6, 5, 25}, distractor{1, 3, 2.4, 5, 25};
};

/// What varies from episode to episode.
struct SearchStimulus {
  double orientation = 0;  ///< rad: direction in which the first element lies, from x
  int target = 0;          ///< which element, 0 to 2, has the target's texture
};

class SearchSurface {
 public:
  static constexpr int kElements = 3;
  /// `uniform` draws evenly from [0, 1): the target's bumps come of it first, then those of both
  /// distractors, which are alike. Throws Error for figures that do not fit each other.
  SearchSurface(const SearchSpec& spec, const SearchStimulus& stimulus,
                const std::function<double()>& uniform);

  const SearchSpec& spec() const noexcept { return spec_; }
  const SearchStimulus& stimulus() const noexcept { return stimulus_; }
  const TroughProfile& groove() const noexcept { return groove_; }
  const TroughProfile& pit() const noexcept { return pit_; }
  const BumpPattern& texture(int element) const noexcept {
    return element == stimulus_.target ? target_ : distractor_;
  }
  std::array<double, 2> middle(int element) const noexcept;  ///< x, y of an element

  /// The height field, with its bumps or without them.
  double height(double x, double y) const noexcept;
  double smoothHeight(double x, double y) const noexcept;
  /// Unit, outward; on a bump that of its hemisphere, at an edge that of the higher side.
  Vec3 normal(double x, double y) const noexcept;

  /// Where a point is over the floor's plane.
  struct Place {
    int element = -1;      ///< whose disc, groove or pit; -1: none
    bool texture = false;  ///< on the textured disc, outside of the pit
    bool pit = false;
    double x = 0, y = 0;  ///< in that element's frame: middle to place, F's directions
  };
  Place place(double x, double y) const noexcept;

  /// Closest point of the free space over the floor and within its walls to p: p itself where that
  /// is free. Of the union of smooth floor and hemispheres, edges included (bump_pattern.h); exact
  /// to rounding, however deep p is. The walls are smooth and come first: a point beyond one is
  /// taken straight to it, and from there to the floor. What is not finite comes back as it is.
  Vec3 closestFree(const Vec3& p) const noexcept;
  /// Within the walls, and no deeper than 1e-9 in the floor: what closestFree gives is free.
  bool isFree(const Vec3& p) const noexcept;
  /// Whether the way from a to b (x, y) enters a bump's footprint in which a is not.
  bool crossesBump(double ax, double ay, double bx, double by) const noexcept;
  /// Height of the bump whose footprint b is in, or else the way from a to b enters; 0: none.
  double bumpOnWay(double ax, double ay, double bx, double by) const noexcept;

 private:
  double smoothHeight(const Place& at) const noexcept;
  bool overFloor(const Vec3& p) const noexcept;
  int bumpEntered(double ax, double ay, double bx,
                  double by) const noexcept;  ///< whose: an element; -1: none
  Vec3 closestOnFloor(const Vec3& p) const noexcept;

  SearchSpec spec_;
  SearchStimulus stimulus_;
  TroughProfile groove_, pit_;
  BumpPattern target_, distractor_;
  std::array<std::array<double, 2>, kElements> middles_;
};

}  // namespace palpa::haptics

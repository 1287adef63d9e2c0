#pragma once

#include <vector>

#include "anatomy/geometry/top_shape.h"

namespace palpa::assess {

/// The part of the top that must be searched: a rectangle about the origin, or what of it lies
/// within an outline, as it is seen from above. Places of a palpation, its samples, marks and
/// lumps, lie along `top` (`alongTop`).
struct SearchArea {
  double half_x = 0.036, half_y = 0.036;  ///< m
  /// M, corner after corner, once around; fewer than three: the whole rectangle
  std::vector<Eigen::Vector2d> outline = {};
  TopShape top = {};
};

/// M from the nearest edge of the area, as seen from above; below 0: outside of it.
double insideBy(const SearchArea& area, const Vec3& p_P);

/// The place of the area that is nearest as seen from above, itself where it lies in it; its z
/// stays.
Vec3 nearestIn(const SearchArea& area, const Vec3& p_P);

/// The place on the top there: z = 0 on a flat one.
Vec3 onTop(const SearchArea& area, const Vec3& p_P);

/// How much longer a way along the top is than it looks from above, where it is steepest in the
/// area: along x and along y. 1 on a flat top.
Eigen::Vector2d foreshortening(const SearchArea& area);

}  // namespace palpa::assess

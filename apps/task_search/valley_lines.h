#pragma once

#include <vector>

#include "apps/task_search/gabor_filter.h"
#include "haptics/surface/valley_map.h"

namespace palpa::task_search {

/// How valleys are looked for; lengths in U.
struct ValleySearch {
  double side = 240;
  double seeds = 0.5;   ///< from seed to seed of the grid that is looked over
  double step = 0.05;   ///< of the central differences
  double widest = 10;   ///< largest radius of curvature that still counts as a valley
  double apart = 0.25;  ///< of the points that are kept, about
};

/// Points of a surface's valleys, found from nothing but its heights: with the gradient g and the
/// Hessian H by central differences, and e the eigenvector of H's largest eigenvalue k,
///   g . e = 0,   k >= 1 / widest        (the slope is zero along the most concave direction;
///   Newton's method along e)
/// Where both eigenvalues are alike it is a pit: g = 0, and no direction. Radius: 1 / k.
std::vector<haptics::ValleyPoint> valleyPoints(const HeightField& height,
                                               const ValleySearch& search);

}  // namespace palpa::task_search

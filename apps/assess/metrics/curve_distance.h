#pragma once

#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::metrics {

using Curve = std::vector<Vec3>;  ///< points, m

/// Every curve is first resampled to this many points at even lengths, so that time spent waiting
/// does not count. A curve that does not move is one point.
constexpr int kCurvePoints = 256;
Curve resampled(const Curve& curve, int points = kCurvePoints);

/// All in m, of resampled curves; not a number where one has no point.
double hausdorff(const Curve& a,
                 const Curve& b);  ///< the farthest that a point of the one lies from the other
double frechet(const Curve& a,
               /// Shortest leash for two that walk the curves without turning back: discrete, Eiter
               /// and Mannila 1994
               const Curve& b);
/// Mean distance along the best alignment: dynamic time warping, Sakoe and Chiba 1978
double timeWarped(const Curve& a, const Curve& b);

}  // namespace palpa::metrics

#pragma once

#include <cstddef>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "apps/bench/cramer_rao.h"
#include "apps/runtime/random_vector.h"
#include "calibration/robust_fit.h"

/// What the studies of estimators draw, and how they read a fit.
namespace palpa::bench::study {

using Random = runtime::RandomStream;

using runtime::normal3;
Vec3 inBall(Random& random);  ///< of radius 1, evenly
Vec3 direction(Random& random);
Mat3 anyRotation(Random& random);

/// Which of n measurements are gross errors: that share of them, drawn.
std::vector<bool> grossErrors(Random& random, std::size_t n, double share);

/// Half of the 95 % intervals of all parameters.
VectorX halves(const calibration::Fit& fit);
VectorX sds(const MatrixX& covariance);

}  // namespace palpa::bench::study

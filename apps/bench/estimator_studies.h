#pragma once

#include <cstddef>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "anatomy/geometry/random_vector.h"
#include "apps/bench/estimate_check.h"
#include "calibration/robust_fit.h"

/// What the studies of estimators draw, and how they read a fit.
namespace palpa::bench::study {

using Random = RandomStream;
Vec3 inBall(Random& random);  ///< of radius 1, evenly
Vec3 direction(Random& random);
Mat3 anyRotation(Random& random);

/// Which of n measurements are gross errors: that share of them, drawn.
std::vector<bool> grossErrors(Random& random, std::size_t n, double share);

/// Half of the 95 % intervals of all parameters.
VectorX halves(const calibration::Fit& fit);
VectorX sds(const MatrixX& covariance);

}  // namespace palpa::bench::study

namespace palpa::bench {

/// Twelve views of a board of 8 by 6 corners, held to every side and turned by up to 45 degrees,
/// corners found to 0.2 px; gross errors are corners 10 to 40 px off. Judged are the nine numbers
/// of the lens; the views' poses are unknown too, to the estimator and in the bound.
EstimateCheck cameraStudy(std::uint64_t seed, double outliers);

/// Realistic noise: an encoder-read device of 0.1 mm and 0.05 degrees, a tag seen at 0.6 m, a hand
/// that touches to 0.5 mm, a force sensor of 0.02 N, corners found to 0.2 px.
std::vector<EstimatorStudy> estimatorStudies();

}  // namespace palpa::bench

#pragma once

#include "apps/bench/estimate_check.h"

namespace palpa::bench {

/// Twelve views of a board of 8 by 6 corners, held to every side and turned by up to 45 degrees,
/// corners found to 0.2 px; gross errors are corners 10 to 40 px off. Judged are the nine numbers
/// of the lens; the views' poses are unknown too, to the estimator and in the bound.
EstimateCheck cameraStudy(std::uint64_t seed, double outliers);

}  // namespace palpa::bench

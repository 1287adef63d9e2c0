#pragma once

#include <vector>

#include "apps/bench/estimate_check.h"

namespace palpa::bench {

/// Realistic noise: an encoder-read device of 0.1 mm and 0.05 degrees, a tag seen at 0.6 m, a hand
/// that touches to 0.5 mm, a force sensor of 0.02 N, corners found to 0.2 px.
std::vector<EstimatorStudy> estimatorStudies();

}  // namespace palpa::bench

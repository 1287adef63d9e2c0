#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "apps/bench/cramer_rao.h"

namespace palpa::bench {

/// One synthetic data set, drawn, estimated, compared with the truth that the estimator does not
/// see.
struct EstimateCheck {
  VectorX error;   ///< estimate less truth, parameter by parameter
  VectorX half95;  ///< half of the stated 95 % intervals
  VectorX bound;   ///< standard deviations of the Cramer-Rao bound without outliers
};

/// `outliers`: share of the measurements that are gross errors.
struct EstimatorStudy {
  std::string name;
  std::function<EstimateCheck(std::uint64_t seed, double outliers)> run;
};

}  // namespace palpa::bench

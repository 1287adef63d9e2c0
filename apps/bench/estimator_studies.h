#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/bench/cramer_rao.h"

namespace palpa::bench {

/// One synthetic data set, drawn, estimated, compared with the truth that the estimator does not see.
struct EstimateCheck {
  VectorX error;    ///< estimate less truth, parameter by parameter
  VectorX half95;   ///< half of the stated 95 % intervals
  VectorX bound;    ///< standard deviations of the Cramer-Rao bound without outliers
};

/// `outliers`: share of the measurements that are gross errors.
struct EstimatorStudy {
  std::string name;
  std::function<EstimateCheck(std::uint64_t seed, double outliers)> run;
};

/// Realistic noise: an encoder-read device of 0.1 mm and 0.05 degrees, a tag seen at 0.6 m, a hand that touches to 0.5 mm, a
/// force sensor of 0.02 N.
std::vector<EstimatorStudy> estimatorStudies();

struct StudyFigures {
  double ratio = 0;         ///< root mean square error over the bound, median of the parameters
  double worst_ratio = 0;   ///< of the parameter for which it is largest
  double coverage = 0;      ///< share of the truths inside the stated 95 % intervals, all parameters
  int refused = 0;          ///< sets for which the estimator gave no answer; said on standard error
};
/// Sets of seeds 1 to `sets`.
StudyFigures figuresOf(const EstimatorStudy& study, int sets, double outliers);

}  // namespace palpa::bench

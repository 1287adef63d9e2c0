#pragma once

#include "apps/bench/estimate_check.h"

namespace palpa::bench {

struct StudyFigures {
  double ratio = 0;        ///< root mean square error over the bound, median of the parameters
  double worst_ratio = 0;  ///< of the parameter for which it is largest
  double coverage = 0;     ///< share of the truths inside the stated 95 % intervals, all parameters
  int refused = 0;         ///< sets for which the estimator gave no answer; said on standard error
};
/// Sets of seeds 1 to `sets`.
StudyFigures figuresOf(const EstimatorStudy& study, int sets, double outliers);

}  // namespace palpa::bench

#pragma once

#include "apps/assess/assess_trial.h"
#include "apps/assess/intervals.h"

namespace palpa::assess {

/// Closest the tip came to an organ while inserted, looked at `rate_Hz` times a second.
struct NearMiss {
  double distance;  ///< m; negative: inside; infinite when never inserted or no such organ
  double t_s = -1;
};
NearMiss nearMiss(Samples samples, Organ organ, const OrganDistance& distance, double rate_Hz);

}  // namespace palpa::assess

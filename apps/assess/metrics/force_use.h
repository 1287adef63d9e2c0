#pragma once

#include "apps/assess/metrics/motion.h"

namespace palpa::metrics {

/// How force was used; "in contact": 0.05 N or more.
constexpr double kContactForce_N = 0.05;
double peakForce(const Motion& motion);  ///< N
double meanForce(const Motion& motion);  ///< N, in contact; not a number without contact
double overForceTime(const Motion& motion, double limit_N);  ///< s above the limit
double forceJerk(
    const Motion& motion);  ///< N/s: root mean square of the force's rate between neighbouring
                            ///< steps in contact; not a number without them

}  // namespace palpa::metrics

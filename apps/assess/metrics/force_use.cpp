#include "apps/assess/metrics/force_use.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpa::metrics {
namespace {

constexpr double kNoForce = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double peakForce(const Motion& motion) {
  return motion.size() == 0 ? kNoForce
                            : *std::max_element(motion.force.begin(), motion.force.end());
}

double meanForce(const Motion& motion) {
  double sum = 0;
  int count = 0;
  for (const double f : motion.force) {
    if (f < kContactForce_N) continue;
    sum += f;
    ++count;
  }
  return count > 0 ? sum / count : kNoForce;
}

double overForceTime(const Motion& motion, double limit_N) {
  return Motion::kStep_s *
         static_cast<double>(std::count_if(motion.force.begin(), motion.force.end(),
                                           [&](double f) { return f > limit_N; }));
}

double forceJerk(const Motion& motion) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 1; i < motion.size(); ++i) {
    if (motion.force[i] < kContactForce_N || motion.force[i - 1] < kContactForce_N) continue;
    const double rate = (motion.force[i] - motion.force[i - 1]) / Motion::kStep_s;
    sum += rate * rate;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : kNoForce;
}

}  // namespace palpa::metrics

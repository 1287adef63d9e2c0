#include "apps/assess/near_miss.h"

#include <limits>

namespace palpa::assess {

NearMiss nearMiss(Samples samples, Organ organ, const OrganDistance& distance, double rate_Hz) {
  NearMiss closest{std::numeric_limits<double>::infinity()};
  for (const std::size_t i : scoringSamples(samples, rate_Hz)) {
    if (samples[i].phase != haptics::NeedlePhase::inserted) continue;
    const double d = distance(organ, samples[i].tip_A);
    if (d < closest.distance) closest = {d, samples[i].t_s};
  }
  return closest;
}

}  // namespace palpa::assess

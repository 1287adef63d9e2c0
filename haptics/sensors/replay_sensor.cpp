#include "haptics/sensors/replay_sensor.h"

#include <algorithm>
#include <utility>

#include "anatomy/geometry/error.h"

namespace palpa::haptics {

ReplaySensor::ReplaySensor(ForceSensorCapabilities capabilities, std::vector<WrenchSample> samples)
    : capabilities_(std::move(capabilities)), samples_(std::move(samples)) {
  const auto back =
      std::is_sorted_until(samples_.begin(), samples_.end(),
                           [](const auto& a, const auto& b) { return a.t_ns < b.t_ns; });
  if (back != samples_.end())
    throw UsageError(
        "sample " + std::to_string(back - samples_.begin()) + " is older than the one before it",
        "force sensor replay", "Sort the samples by time.");
}

WrenchSample ReplaySensor::read(std::int64_t now_ns) noexcept {
  const auto next =
      std::upper_bound(samples_.begin(), samples_.end(), now_ns,
                       [](std::int64_t t, const WrenchSample& sample) { return t < sample.t_ns; });
  if (next != samples_.begin()) return *(next - 1);
  WrenchSample none;
  none.flags = kNothingYet;
  return none;
}

}  // namespace palpa::haptics

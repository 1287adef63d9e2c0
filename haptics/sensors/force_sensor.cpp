#include "haptics/sensors/force_sensor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "anatomy/base/error.h"

namespace palpa::haptics {
namespace {

bool atRange(const Packed3& value, const Packed3& range) noexcept {
  for (std::size_t i = 0; i < 3; ++i)
    if (range[i] > 0 && std::abs(value[i]) >= range[i]) return true;
  return false;
}

}  // namespace

std::uint32_t overloadFlag(const ForceSensorCapabilities& range,
                           const WrenchSample& sample) noexcept {
  const bool over =
      atRange(sample.f_S, range.max_force_N) || atRange(sample.tau_S, range.max_torque_Nm);
  return over ? kOverload : 0u;
}

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

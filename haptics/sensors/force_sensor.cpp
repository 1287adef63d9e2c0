#include "haptics/sensors/force_sensor.h"

#include <cmath>

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

}  // namespace palpa::haptics

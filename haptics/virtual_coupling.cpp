#include "haptics/virtual_coupling.h"

#include <algorithm>
#include <cmath>

namespace palpa::haptics {

double couplingStiffness(const DeviceCapabilities& device, double period_s, double virtual_damping,
                         double grip_damping) noexcept {
  if (!(period_s > 0)) return 0;
  const double damping = device.viscous_damping + grip_damping;
  double stiffness = (damping - std::abs(virtual_damping)) / (period_s / 2 + device.delay);
  if (device.coulomb_friction > 0 && device.position_resolution > 0)
    stiffness = std::min(stiffness, 2 * device.coulomb_friction / device.position_resolution);
  if (device.stable_stiffness > 0) stiffness = std::min(stiffness, device.stable_stiffness);
  return std::max(stiffness, 0.0);
}

}  // namespace palpa::haptics

#pragma once

#include "haptics/device.h"

namespace palpa::haptics {

/// The lightest grip that must not make the device shake: a loose pen grip, 2 N s/m.
inline constexpr double kLightestGrip = 2;

/// Largest stiffness that a device can render with the period T (s) and the virtual damping B (N
/// s/m):
///   K <= (b - |B|) / (T/2 + t_d)   b: damping of device and hand (Colgate and Schenkel 1997), t_d:
///   the device's delay K <= 2 f_c / Delta        f_c: Coulomb friction, Delta: encoder step
///   (Abbott and Okamura 2005); where both are known K <= what its maker or a measurement says is
///   stable, where known
/// At least 0. Throws nothing; a device without any data gets 0.
double couplingStiffness(const DeviceCapabilities& device, double period_s,
                         double virtual_damping = 0, double grip_damping = kLightestGrip) noexcept;

}  // namespace palpa::haptics

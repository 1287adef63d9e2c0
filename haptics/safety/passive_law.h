#pragma once

#include "haptics/device.h"
#include "haptics/safety/passivity.h"

/// What must be known before a law is begun that takes away: how much of it a device and a hand
/// can bear. Not for the tick.
namespace palpa::haptics {

/// How late the force of a law answers: the loop's period, s, and what goes by beyond it, s: the
/// filter of the force sensor, the device.
struct LoopDelay {
  double period_s = 1e-3, beyond_s = 0;
};

/// Motion to force by a law that damps a band alone, a mechanical resonator without a mass of its
/// own: N s/m
///     C(s) = c 2 z w s / (s^2 + 2 z w s + w^2),   w = 2 pi sqrt(f1 f2),  2 z = (f2 - f1)/sqrt(f1
///     f2)
/// c in the middle of the band, c/sqrt(2) at its ends f1 and f2, Hz. Its real part is above zero
/// everywhere, so without delay it can only take energy.
struct DampedBand {
  double from_Hz = 8, to_Hz = 12;
  double damping = 0;  ///< c, N s/m

  double omega() const noexcept;  ///< rad/s
  double ratio() const noexcept;  ///< 2 z
};

/// N s/m: the damping that device and hand must have where a spring of so many N/m is taken away
/// from something that is at least as stiff (Colgate and Schenkel 1997, with a delay t):
///     b > max over w of  -K T/2 sin(w (t + T/2)) / sin(w T/2),   0 < w <= pi/T
/// Late, it damps slow motion (a spring that is added makes energy there), and shakes only where it
/// is late by more than half a turn: at most 0.217 K (t + T/2) where the delay is many periods.
double dampingForTaken(double stiffness, const LoopDelay& delay) noexcept;

/// N/m: the stiffest spring that may be taken away from something stiffer,
///     K <= (b_device + b_grip) / what one N/m needs,   K <= 2 f_c / Delta  (Abbott, Okamura 2005)
/// the second where both are known.
double largestTaken(const DeviceCapabilities& device, const LoopDelay& delay,
                    double grip_damping = kLightestGrip) noexcept;

/// N s/m: the same for a damped band: what the delay turns against the hand,
///     b > max over w of  T/2 / (1 - cos w T) Re{(1 - exp(-jwT)) C(z) (1 - 1/z)/T exp(-jwt)}
/// C(z): C(s) by the trapezoidal rule, as the tick has it.
double dampingForBand(const DampedBand& band, const LoopDelay& delay) noexcept;
/// N s/m: the largest c of such a band.
double largestBandDamping(const DampedBand& band, const DeviceCapabilities& device,
                          const LoopDelay& delay, double grip_damping = kLightestGrip) noexcept;

/// s, at a frequency within the band: how late its force is behind the velocity that it is against;
/// below the band's middle it is early (negative).
double bandDelay(const DampedBand& band, const LoopDelay& delay, double at_Hz) noexcept;
/// s: how long it takes to answer a tremor that begins (to 63 %), 1 / (z w).
double bandSettling(const DampedBand& band) noexcept;

}  // namespace palpa::haptics

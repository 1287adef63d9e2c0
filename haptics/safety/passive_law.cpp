#include "haptics/safety/passive_law.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "anatomy/base/pinned_math.h"

namespace palpa::haptics {
namespace {

using Complex = std::complex<double>;

constexpr double kPi = std::numbers::pi;
constexpr int kFrequencies = 4000;  // from one to the next: an eighth of a hertz at 1 kHz

Complex turn(double angle) noexcept { return {pinned::cos(angle), pinned::sin(angle)}; }

/// The largest over all frequencies that a loop of this period has; at least 0.
template <typename Needed>
double largestOver(double period, Needed needed) noexcept {
  double most = 0;
  for (int i = 1; i <= kFrequencies; ++i)
    most = std::max(most, needed(kPi / period * i / kFrequencies));
  return most;
}

/// C(z) / c at w: s becomes 2/T (z - 1)/(z + 1).
Complex bandAt(const DampedBand& band, double omega, double period) noexcept {
  const Complex z = turn(omega * period);
  if (std::norm(z + 1.0) < 1e-24) return 0;  // no more than half the rate gets through
  const Complex s = 2 / period * (z - 1.0) / (z + 1.0);
  const double w = band.omega();
  return band.ratio() * w * s / (s * s + band.ratio() * w * s + w * w);
}

bool ticks(const LoopDelay& delay) noexcept { return delay.period_s > 0 && delay.beyond_s >= 0; }

}  // namespace

double DampedBand::omega() const noexcept { return 2 * kPi * std::sqrt(from_Hz * to_Hz); }
double DampedBand::ratio() const noexcept { return (to_Hz - from_Hz) / std::sqrt(from_Hz * to_Hz); }

double dampingForTaken(double stiffness, const LoopDelay& delay) noexcept {
  if (!ticks(delay)) return std::numeric_limits<double>::infinity();
  const double half = delay.period_s / 2;
  return stiffness * largestOver(delay.period_s, [&](double w) {
           return -half * pinned::sin(w * (delay.beyond_s + half)) / pinned::sin(w * half);
         });
}

double largestTaken(const DeviceCapabilities& device, const LoopDelay& delay,
                    double grip_damping) noexcept {
  if (!ticks(delay)) return 0;
  const LoopDelay whole{delay.period_s, delay.beyond_s + device.delay};
  const double each = dampingForTaken(1, whole), damping = device.viscous_damping + grip_damping;
  double most = each > 0 ? damping / each : std::numeric_limits<double>::infinity();
  if (device.coulomb_friction > 0 && device.position_resolution > 0)
    most = std::min(most, 2 * device.coulomb_friction / device.position_resolution);
  return std::max(most, 0.0);
}

double dampingForBand(const DampedBand& band, const LoopDelay& delay) noexcept {
  if (!ticks(delay)) return std::numeric_limits<double>::infinity();
  const double T = delay.period_s;
  return band.damping * largestOver(T, [&](double w) {
           const Complex difference = 1.0 - turn(-w * T);
           const Complex spring = bandAt(band, w, T) * difference / T * turn(-w * delay.beyond_s);
           return 0.5 * T / (1 - pinned::cos(w * T)) * (difference * spring).real();
         });
}

double largestBandDamping(const DampedBand& band, const DeviceCapabilities& device,
                          const LoopDelay& delay, double grip_damping) noexcept {
  if (!ticks(delay)) return 0;
  const DampedBand one{band.from_Hz, band.to_Hz, 1};
  const double each = dampingForBand(one, {delay.period_s, delay.beyond_s + device.delay});
  return each > 0 ? (device.viscous_damping + grip_damping) / each
                  : std::numeric_limits<double>::infinity();
}

/// The difference of two places is half a period late, and so is a force that is held for one.
double bandDelay(const DampedBand& band, const LoopDelay& delay, double at_Hz) noexcept {
  const double w = 2 * kPi * at_Hz;
  if (!ticks(delay) || !(w > 0)) return 0;
  const Complex through = bandAt(band, w, delay.period_s);
  return delay.period_s + delay.beyond_s - pinned::atan2(through.imag(), through.real()) / w;
}

double bandSettling(const DampedBand& band) noexcept {
  const double rate = 0.5 * band.ratio() * band.omega();
  return rate > 0 ? 1 / rate : std::numeric_limits<double>::infinity();
}

}  // namespace palpa::haptics

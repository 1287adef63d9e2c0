#include "haptics/sensors/low_pass.h"

#include <cmath>
#include <numbers>
#include <string>

#include "anatomy/geometry/error.h"

namespace palpa::haptics {

LowPass butterworth(double cutoff_Hz, double rate_Hz) {
  if (!(cutoff_Hz > 0) || !(cutoff_Hz < rate_Hz / 2))
    throw UsageError("a cut-off of " + std::to_string(cutoff_Hz) + " Hz at " +
                         std::to_string(rate_Hz) + " samples a second",
                     "force filter", "It must lie between 0 and half the rate.");
  const double K = std::tan(std::numbers::pi * cutoff_Hz / rate_Hz);
  const double a0 = 1 + std::numbers::sqrt2 * K + K * K;
  const double b = K * K / a0;
  return {b, 2 * b, b, 2 * (K * K - 1) / a0, (1 - std::numbers::sqrt2 * K + K * K) / a0};
}

}  // namespace palpa::haptics

#include "haptics/sensors/wrench_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "anatomy/base/error.h"

namespace palpa::haptics {
namespace {

constexpr double kRate = 1000, kTau = 2 * std::numbers::pi;

/// Response to a cosine of `f` Hz, from the samples of one second after two that let it swing in.
/// `f` is whole, so that the second holds whole periods.
std::complex<double> response(const LowPass& filter, int f) {
  LowPassState<1> state;
  std::complex<double> sum = 0;
  for (int k = 0; k < 3000; ++k) {
    const double phase = kTau * f * k / kRate;
    const double y = apply(filter, state, std::array{std::cos(phase)})[0];
    if (k >= 2000) sum += y * std::polar(1.0, -phase);
  }
  return sum / (f == 0 ? 1000.0 : 500.0);
}

TEST(LowPass, PassesRestAndHalvesThePowerAtTheCutOff) {
  for (const int cutoff : {20, 50, 200}) {
    const LowPass filter = butterworth(cutoff, kRate);
    EXPECT_NEAR(std::abs(response(filter, 0)), 1, 1e-12);
    EXPECT_NEAR(std::abs(response(filter, cutoff)), std::sqrt(0.5), 1e-12);
  }
}

TEST(LowPass, GainIsButterworthsOnTheWarpedAxisAndThePhaseFallsAllTheWay) {
  const LowPass filter = butterworth(40, kRate);
  double last = 0;
  for (int f = 1; f < 480; f += 3) {
    const double ratio = std::tan(kTau * f / kRate / 2) / std::tan(kTau * 40 / kRate / 2);
    const std::complex<double> H = response(filter, f);
    EXPECT_NEAR(std::abs(H), 1 / std::sqrt(1 + std::pow(ratio, 4)), 1e-12) << f;
    EXPECT_LT(std::arg(H), last) << f;
    last = std::arg(H);
  }
  EXPECT_GT(last, -std::numbers::pi) << "second order: half a turn at most";
}

TEST(LowPass, SlowSignalsAreDelayedAsStated) {
  const double cutoff = 40, delay = std::numbers::sqrt2 / (kTau * cutoff);
  EXPECT_NEAR(-std::arg(response(butterworth(cutoff, kRate), 1)) / kTau, delay, 0.01 * delay);
}

TEST(LowPass, AStepOvershootsByExpMinusPiAndNoMore) {
  const LowPass filter = butterworth(10, kRate);
  LowPassState<1> state;
  double highest = 0, y = 0;
  for (int k = 0; k < 2000; ++k) {
    y = apply(filter, state, std::array{1.0})[0];
    highest = std::max(highest, y);
  }
  // Damping 1/sqrt(2): exp(-pi). 1e-4: the peak lies between two samples, and the axis is warped.
  EXPECT_NEAR(highest, 1 + std::exp(-std::numbers::pi), 1e-4);
  EXPECT_NEAR(y, 1, 1e-12);
}

TEST(LowPass, SettledItStartsWhereItIs) {
  const LowPass filter = butterworth(30, kRate);
  LowPassState<2> state;
  const std::array x{3.5, -2.0};
  settle(filter, state, x);
  for (int k = 0; k < 100; ++k) {
    const auto y = apply(filter, state, x);
    ASSERT_NEAR(y[0], 3.5, 1e-12);
    ASSERT_NEAR(y[1], -2.0, 1e-12);
  }
}

TEST(LowPass, ACutOffOutsideTheBandIsRefused) {
  for (const double cutoff : {0.0, -5.0, 500.0, 2000.0, std::nan("")})
    EXPECT_THROW(butterworth(cutoff, kRate), UsageError) << cutoff;
}

}  // namespace
}  // namespace palpa::haptics

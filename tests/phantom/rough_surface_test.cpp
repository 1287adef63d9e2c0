#include "apps/twin/phantom/rough_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace palpa::twin {
namespace {

double rms(const std::vector<double>& x) {
  double squares = 0;
  for (const double v : x) squares += v * v / static_cast<double>(x.size());
  return std::sqrt(squares);
}

/// Amplitude at one frequency.
double amplitude(const std::vector<double>& x, double f_Hz) {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += x[i] * std::polar(1.0, -2 * std::numbers::pi * f_Hz * 1e-3 * static_cast<double>(i));
  return 2 * std::abs(sum) / static_cast<double>(x.size());
}

RoughTool silent() {
  RoughTool tool;
  tool.noise_m_s2 = 0;
  return tool;
}

TEST(RoughSurface, SmoothSurfacesDoNotShake) {
  RoughSurface flat;
  flat.rms = 1e-12;
  const RoughRecording recording = strokeRough(flat, silent(), {1, 0.1, 1, 0, 1});
  ASSERT_EQ(recording.acceleration.size(), 1000u);
  EXPECT_LT(rms(recording.acceleration), 1e-4);
}

/// Low, even ribs far below the contact's resonance: the tool follows them, a = (2 pi f)^2 h / 2
/// with f = v / period.
TEST(RoughSurface, FollowsSlowRibs) {
  RoughSurface ribbed;
  ribbed.rms = 1e-12;
  ribbed.rib_period = 2e-3;
  ribbed.rib_height = 4e-6;
  ribbed.stiffness = 1e9;
  const RoughRecording recording = strokeRough(ribbed, silent(), {1, 0.05, 4, 0, 1});
  const double turn = 2 * std::numbers::pi * 25;
  EXPECT_NEAR(amplitude(recording.acceleration, 25) / (turn * turn * 2e-6), 1, 0.05);
}

/// Nothing above half the recording's rate comes back below it: ribs at 600 Hz.
TEST(RoughSurface, RecordsNoAliases) {
  RoughSurface ribbed;
  ribbed.rms = 1e-12;
  ribbed.rib_period = 0.25e-3;
  ribbed.rib_height = 0.5e-6;
  ribbed.stiffness = 1e9;
  const RoughRecording recording = strokeRough(ribbed, silent(), {1, 0.15, 4, 0, 1});
  EXPECT_LT(amplitude(recording.acceleration, 400),
            1e-3 * std::pow(2 * std::numbers::pi * 600, 2) * 0.25e-6);
}

TEST(RoughSurface, ShakesMoreWhenFaster) {
  RoughSurface rough;
  rough.rms = 1.5e-6;
  EXPECT_GT(rms(strokeRough(rough, silent(), {1, 0.15, 4, 0.05, 2}).acceleration),
            1.5 * rms(strokeRough(rough, silent(), {1, 0.05, 4, 0.05, 2}).acceleration));
}

TEST(RoughSurface, TheSameSeedIsTheSameStroke) {
  RoughSurface rough;
  rough.rms = 1.5e-6;
  const RoughStroke stroke{1, 0.1, 1, 0.05, 7};
  EXPECT_EQ(strokeRough(rough, {}, stroke).acceleration,
            strokeRough(rough, {}, stroke).acceleration);
}

TEST(RoughSurface, ShippedSurfacesKeepTheTipOn) {
  const RoughBench bench =
      readRoughBench(std::string(PALPA_SOURCE_DIR) + "/assets/phantoms/textures/surfaces.json");
  ASSERT_GE(bench.surfaces.size(), 4u);
  for (const RoughSurface& surface : bench.surfaces) {
    const RoughRecording recording = strokeRough(surface, bench.tool, {1, 0.095, 2, 0.05, 3});
    // the tool never falls: what is missing below is what its damping takes of it
    for (const double a : recording.acceleration) EXPECT_GT(a, -1 / bench.tool.mass - 5);
    EXPECT_GT(rms(recording.acceleration), 1) << surface.name;
    EXPECT_LT(rms(recording.acceleration), 8) << surface.name;
  }
}

}  // namespace
}  // namespace palpa::twin

#include "calibration/touch/texture_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "anatomy/base/random.h"
#include "calibration/touch/third_octave.h"
#include "tests/support/complaint.h"

/// A texture that was made by a known filter is found again; strokes that cannot tell it are
/// refused.
namespace palpa::calibration {
namespace {

constexpr double kStep = 1e-3;
const TextureGrid kTwoByTwo{{0.5, 1.0}, {0.05, 0.1}};

/// y_n = -a1 y_n-1 - a2 y_n-2 + sd e: a resonance; w = y_n - r y_n-1.
struct Planted {
  double a1 = -1.2, a2 = 0.8, sd = 0.05;
};

TextureStroke strokeOf(const Planted& planted, double f_n, double speed, double seconds,
                       std::uint64_t seed) {
  RandomStream random(seed, "texture_model_test");
  TextureStroke stroke;
  double y1 = 0, y2 = 0;
  for (int i = 0; i < static_cast<int>(seconds / kStep); ++i) {
    const double y = -planted.a1 * y1 - planted.a2 * y2 + planted.sd * random.normal();
    stroke.push_back({f_n, speed, y - haptics::kTextureLeak * y1});
    y2 = y1;
    y1 = y;
  }
  return stroke;
}

using palpa::test::complaint;
using palpa::test::says;

std::vector<TextureStroke> strokesOn(const TextureGrid& grid, const Planted& planted,
                                     double seconds, std::uint64_t seed) {
  std::vector<TextureStroke> strokes;
  for (const double f : grid.forces)
    for (const double v : grid.speeds)
      strokes.push_back(strokeOf(planted, f, v, seconds, seed + strokes.size()));
  return strokes;
}

std::string textureRefusal(const std::vector<TextureStroke>& strokes, double dt = kStep,
                           const TextureGrid& grid = kTwoByTwo) {
  return complaint([&] { identifyTexture(strokes, dt, grid); });
}

TEST(TextureModel, FindsAPlantedFilter) {
  const Planted planted;
  const TextureModel found =
      identifyTexture(strokesOn(kTwoByTwo, planted, 20, 1), kStep, kTwoByTwo);
  ASSERT_EQ(found.law.forces, 2u);
  ASSERT_EQ(found.law.speeds, 2u);
  EXPECT_NEAR(found.law.ln_force[1], std::log(1.0), 1e-9);
  EXPECT_NEAR(found.law.ln_speed[0], std::log(0.05), 1e-9);
  // k_2 = a_2, k_1 = a_1 / (1 + a_2); variance sd^2 / ((1 - k_1^2) (1 - k_2^2))
  const double k2 = planted.a2, k1 = planted.a1 / (1 + planted.a2),
               rms = planted.sd / std::sqrt((1 - k1 * k1) * (1 - k2 * k2));
  for (std::size_t f = 0; f < 2; ++f) {
    for (std::size_t v = 0; v < 2; ++v) {
      const haptics::TextureNode& node = found.law.nodes[f][v];
      // asymptotic standard errors sqrt((1 - k^2) / N) and less: 0.006 of 20 000; four of them
      EXPECT_NEAR(node.reflection[0], k1, 0.024);
      EXPECT_NEAR(node.reflection[1], k2, 0.024);
      EXPECT_NEAR(std::exp(node.ln_rms) / rms, 1, 0.05);
      for (std::size_t i = 2; i < found.law.order; ++i) EXPECT_NEAR(node.reflection[i], 0, 0.035);
    }
  }
  EXPECT_LT(found.level_sd_dB, 0.5);
  EXPECT_NEAR(found.lowest_band_sd_dB, 0.46, 0.02);
}

TEST(TextureModel, RendersWhatWasRecorded) {
  const TextureModel found = identifyTexture(strokesOn(kTwoByTwo, {}, 30, 2), kStep, kTwoByTwo);
  const TextureStroke fresh = strokeOf({}, 0.7, 0.07, 30, 99);
  std::vector<double> recorded;
  for (const TextureSample& s : fresh) recorded.push_back(s.shake);
  const auto off =
      levelDifference(thirdOctavePowers(renderedTexture(found.law, fresh, kStep), 1 / kStep),
                      thirdOctavePowers(recorded, 1 / kStep));
  for (int i = 0; i < kThirdOctaves; ++i)  // 0.4 dB of chance at 20 Hz in 30 s, and the fit's
    EXPECT_NEAR(off[static_cast<std::size_t>(i)], 0, 2) << thirdOctaveCentre(i) << " Hz";
}

TEST(TextureModel, RefusesWhatCannotTell) {
  const std::vector<TextureStroke> good = strokesOn(kTwoByTwo, {}, 6, 3);
  EXPECT_EQ(textureRefusal(good), "");
  EXPECT_TRUE(says(textureRefusal(good, 2e-3), "1 kHz"));
  EXPECT_TRUE(says(textureRefusal(strokesOn(kTwoByTwo, {}, 2, 3)),
                   "steady strokes are near 0.50 N and 50.00 mm/s"));
  EXPECT_TRUE(says(textureRefusal(good, kStep, {{0.5, 3.0}, {0.05, 0.1}}), "3.00 N"));
  EXPECT_TRUE(says(textureRefusal(good, kStep, {{1.0, 0.5}, {0.05}}), "rising"));
  EXPECT_TRUE(says(textureRefusal({}), "too few"));
  std::vector<TextureStroke> cut = good;
  for (TextureStroke& stroke : cut)
    for (TextureSample& s : stroke) s.shake = std::clamp(s.shake, -0.05, 0.05);
  EXPECT_TRUE(says(textureRefusal(cut), "cut off"));
  std::vector<TextureStroke> silent = good;
  for (TextureStroke& stroke : silent)
    for (TextureSample& s : stroke) s.shake = 0;
  EXPECT_TRUE(says(textureRefusal(silent), "nothing shakes"));
  std::vector<TextureStroke> broken = good;
  broken[1][700].speed = std::nan("");
  EXPECT_TRUE(says(textureRefusal(broken), "not a number"));
}

TEST(TextureModel, PiecesThatAreNotSteadyDoNotCount) {
  std::vector<TextureStroke> strokes = strokesOn(kTwoByTwo, {}, 6, 4);
  for (std::size_t i = 0; i < strokes[0].size(); ++i)
    strokes[0][i].speed *= 1 + 0.5 * std::sin(2 * std::numbers::pi * 8e-3 * static_cast<double>(i));
  EXPECT_TRUE(says(textureRefusal(strokes), "steady"));
}

TEST(ThirdOctave, ASineIsInItsBandAlone) {
  std::vector<double> sine;
  for (int i = 0; i < 10'000; ++i)
    sine.push_back(std::sqrt(2.0) *
                   std::sin(2 * std::numbers::pi * thirdOctaveCentre(7) * 1e-3 * i));
  const auto powers = thirdOctavePowers(sine, 1000);
  for (std::size_t i = 0; i < powers.size(); ++i)
    EXPECT_NEAR(powers[i], i == 7 ? 1 : 0, 2e-3) << thirdOctaveCentre(static_cast<int>(i));
}

/// White noise of variance 1 at 1 kHz has B / 500 Hz in each band.
TEST(ThirdOctave, WhiteNoiseByWidth) {
  RandomStream random(5, "third_octave_test");
  std::vector<double> noise;
  for (int i = 0; i < 200'000; ++i) noise.push_back(random.normal());
  const auto powers = thirdOctavePowers(noise, 1000);
  for (int i = 0; i < kThirdOctaves; ++i) {
    const double width = thirdOctaveCentre(i) * (std::pow(10, 0.05) - std::pow(10, -0.05));
    EXPECT_NEAR(powers[static_cast<std::size_t>(i)] / (width / 500), 1, 4 / std::sqrt(width * 200));
  }
}

}  // namespace
}  // namespace palpa::calibration

#include "calibration/touch/contact_laws.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "anatomy/base/error.h"

namespace palpa::calibration {
namespace {

using haptics::Dahl;
constexpr double kTick = 1e-3;

struct Strokes {
  double way = 0.03, slow_Hz = 0.4, fast_Hz = 1.5, seconds = 6, f_n = 1, swing_N = 0.3, noise_N = 0,
         noise_m = 0;
};

/// Back and forth along a line that is askew, over a surface whose normal force swings; the drag by
/// Dahl's law in its differential form, in steps of a hundredth of a tick.
std::vector<SlideSample> stroked(const Dahl& law, const Strokes& how, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Vec3 n = Vec3(0.2, -0.1, 1).normalized(), along = n.cross(Vec3(0.3, 1, 0)).normalized();
  std::vector<SlideSample> samples;
  double F = 0, phase = 0, x = 0;
  for (int i = 0; i < static_cast<int>(how.seconds / kTick); ++i) {
    const double t = kTick * i, f_n = how.f_n + how.swing_N * std::sin(2.1 * t),
                 limit = law.mu * f_n;
    constexpr int kParts = 100;
    const double from = x;
    for (int part = 0; part < kParts; ++part) {
      phase += 2 * std::numbers::pi *
               (how.slow_Hz + (how.fast_Hz - how.slow_Hz) * t / how.seconds) * kTick / kParts;
      const double to = 0.5 * how.way * (1 - std::cos(phase)), dx = to - x;
      F = std::clamp(F + law.sigma * dx * (1 - F / limit * (dx > 0 ? 1 : -1)), -limit, limit);
      x = to;
    }
    SlideSample s;
    s.n = n;
    s.f_n = f_n;
    s.p = (x + how.noise_m * normal(random)) * along;
    s.drag = (F + law.B * (x - from) / kTick) * along;
    for (int a = 0; a < 3; ++a) s.drag[a] += how.noise_N * normal(random);
    samples.push_back(s);
  }
  return samples;
}

const Dahl kRubber{0.8, 1500, 2}, kSlick{0.15, 800, 0.3};

TEST(SurfaceFriction, FindsTheLawThatMadeTheDrag) {
  for (const Dahl& law : {kRubber, kSlick}) {
    const SurfaceFriction found = identifySurfaceFriction(stroked(law, {}), kTick);
    EXPECT_NEAR(found.law.mu, law.mu, 0.005 * law.mu);
    EXPECT_NEAR(found.law.sigma, law.sigma, 0.02 * law.sigma);
    EXPECT_NEAR(found.law.B, law.B, 0.02 * law.B);
    EXPECT_LT(found.relative_rms, 0.01);
    EXPECT_GT(found.slid, 3);
  }
}

TEST(SurfaceFriction, KnowsHowWellItIsToldInNoise) {
  Strokes how;
  how.noise_N = 0.03;
  int within = 0;
  const int runs = 20;
  for (int run = 0; run < runs; ++run) {
    const SurfaceFriction found =
        identifySurfaceFriction(stroked(kRubber, how, 10u + static_cast<unsigned>(run)), kTick);
    const Vec3 half = 1.96 * found.covariance.diagonal().cwiseSqrt();
    within += std::abs(found.law.mu - kRubber.mu) <
              half[0] + 0.001 * kRubber.mu;  // the difference of the two forms of the law
    within += std::abs(found.law.sigma - kRubber.sigma) < half[1] + 0.005 * kRubber.sigma;
    within += std::abs(found.law.B - kRubber.B) < half[2] + 0.005 * kRubber.B;
    EXPECT_NEAR(found.rms, how.noise_N, 0.003);
  }
  EXPECT_GE(within,
            51);  // binomial, 60 draws at 0.95: three and a half standard deviations below 57
}

std::string refusalOf(const std::vector<SlideSample>& samples) {
  try {
    identifySurfaceFriction(samples, kTick);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SurfaceFriction, DataThatCannotTellAreRefusedInWords) {
  const auto says = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(refusalOf({}), "too few"));
  Strokes once;
  once.slow_Hz = once.fast_Hz = 0.08;
  EXPECT_TRUE(says(refusalOf(stroked(kRubber, once)), "strokes are too few"));
  Strokes tiny;
  tiny.way = 0.0004;
  EXPECT_NE(refusalOf(stroked(kRubber, tiny)), "");
  std::vector<SlideSample> wrong = stroked(kRubber, {});
  for (SlideSample& s : wrong) s.drag = -s.drag;
  EXPECT_TRUE(says(refusalOf(wrong), "drags along the motion"));
  std::vector<SlideSample> none = stroked(kRubber, {});
  none[7].drag.x() = std::nan("");
  EXPECT_TRUE(says(refusalOf(none), "not a number"));
}

}  // namespace
}  // namespace palpa::calibration

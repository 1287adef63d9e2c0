#include "calibration/touch/contact_laws.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "anatomy/base/error.h"

namespace palpa::calibration {
namespace {

using haptics::HuntCrossley;

struct Recording {
  double depth = 0.012, slow = 0.5, fast = 3;  ///< m; Hz of the slowest and the fastest press
  double offset = 0;                           ///< m that the surface is thought too high
  double noise_N = 0, noise_m = 0;
  double seconds = 8;
};

/// Presses and releases that get faster and vary in depth, 1 kHz, the force by the law itself.
std::vector<PressSample> pressed(const HuntCrossley& law, const Recording& how, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<PressSample> samples;
  double phase = 0;
  for (int i = 0; i < static_cast<int>(1000 * how.seconds); ++i) {
    const double t = 1e-3 * i, rate_Hz = how.slow + (how.fast - how.slow) * t / how.seconds;
    phase += 2 * std::numbers::pi * rate_Hz * 1e-3;
    const double depth = how.depth * (0.7 + 0.3 * std::sin(0.9 * t));
    const double x = depth * 0.5 * (1 - std::cos(phase)) - 0.0005,
                 speed = depth * 0.5 * std::sin(phase) * 2 * std::numbers::pi * rate_Hz;
    const double f = x > 0 ? law.k * std::pow(x, law.m) * (1 + law.b / law.k * speed) : 0;
    samples.push_back(
        {x + how.offset + how.noise_m * normal(random), speed, f + how.noise_N * normal(random)});
  }
  return samples;
}

const HuntCrossley kSoft{2000, 3000, 1.4}, kFirm{9000, 2000, 1.1}, kLively{400, 900, 1.8};

TEST(SoftContact, FindsTheLawThatMadeTheForce) {
  for (const HuntCrossley& law : {kSoft, kFirm, kLively}) {
    const SoftContact found = identifySoftContact(pressed(law, {}));
    EXPECT_NEAR(found.law.k, law.k, 0.001 * law.k);
    EXPECT_NEAR(found.law.b, law.b, 0.001 * law.b);
    EXPECT_NEAR(found.law.m, law.m, 0.001);
    EXPECT_NEAR(found.x0, 0, 1e-6);
    EXPECT_LT(found.relative_rms, 1e-4);
    EXPECT_EQ(found.advice, "");
  }
}

/// A surface that is 0.1 mm off shifts k by tens of per cent in a fit that believes it.
TEST(SoftContact, FindsWhereTheSurfaceTrulyIs) {
  for (const double offset : {0.0003, -0.0001}) {
    Recording how;
    how.offset = offset;
    const SoftContact found = identifySoftContact(pressed(kSoft, how));
    EXPECT_NEAR(found.x0, offset, 2e-6) << offset;
    EXPECT_NEAR(found.law.k, kSoft.k, 0.005 * kSoft.k) << offset;
  }
}

/// With a sensor's noise the true law lies in the 95 % intervals about as often as they say.
TEST(SoftContact, KnowsHowWellItIsTold) {
  Recording how;
  how.noise_N = 0.02;
  int within = 0;
  const int runs = 40;
  for (int run = 0; run < runs; ++run) {
    const SoftContact found =
        identifySoftContact(pressed(kSoft, how, 100u + static_cast<unsigned>(run)));
    const Eigen::Vector4d half = 1.96 * found.covariance.diagonal().cwiseSqrt();
    within += std::abs(found.law.k - kSoft.k) < half[0];
    within += std::abs(found.law.b - kSoft.b) < half[1];
    within += std::abs(found.law.m - kSoft.m) < half[2];
    within += std::abs(found.x0) < half[3];
    EXPECT_NEAR(found.rms, how.noise_N, 0.002);
  }
  EXPECT_GE(within, 4 * runs * 88 /
                        100);  // binomial, 160 draws at 0.95: 0.88 is four standard deviations off
}

TEST(SoftContact, WhileItIsPressedTheLawComesNear) {
  PressEstimator estimator(1);
  const HuntCrossley gentle{2000, 300, 1.4};  // b x'/k below 0.03: there the linearisation holds
  for (const PressSample& s : pressed(gentle, {})) estimator.add(s);
  EXPECT_NEAR(estimator.law().k, gentle.k, 0.02 * gentle.k);
  EXPECT_NEAR(estimator.law().m, gentle.m, 0.01);
  EXPECT_NEAR(estimator.law().b, gentle.b, 0.1 * gentle.b);
}

/// It forgets what it pressed before.
TEST(SoftContact, TheEstimatorFollowsToAnotherMaterial) {
  PressEstimator estimator(0.998);
  for (const HuntCrossley& law : {HuntCrossley{2000, 100, 1.4}, HuntCrossley{9000, 200, 1.1}})
    for (const PressSample& s : pressed(law, {})) estimator.add(s);
  EXPECT_NEAR(estimator.law().m, 1.1, 0.03);
  EXPECT_NEAR(estimator.law().k, 9000, 0.15 * 9000);
}

std::string refusal(const std::vector<PressSample>& samples) {
  try {
    identifySoftContact(samples);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SoftContact, DataThatCannotTellAreRefusedInWords) {
  const auto says = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  const std::vector<PressSample> good = pressed(kSoft, {});
  Recording noisy;
  noisy.noise_N = 0.02;
  EXPECT_TRUE(says(refusal({}), "too few"));
  std::vector<PressSample> only_in, cut, none = good, one_depth, backwards = good;
  for (const PressSample& s : good)
    if (s.rate > 0) only_in.push_back(s);
  EXPECT_TRUE(says(refusal(only_in), "only pressed"));
  for (PressSample s : good) cut.push_back((s.f = std::min(s.f, 1.5), s));
  EXPECT_TRUE(says(refusal(cut), "saturated"));
  none[100].f = std::nan("");
  EXPECT_TRUE(says(refusal(none), "not a number"));
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    const double x = 0.008 + 1e-5 * std::sin(0.01 * i), rate = 1e-4 * std::cos(0.01 * i);
    one_depth.push_back({x, rate, 2000 * std::pow(x, 1.4) + 0.02 * normal(random)});
  }
  EXPECT_NE(refusal(one_depth), "");
  Recording creeping = noisy;
  creeping.slow = creeping.fast = 0.05;
  creeping.seconds = 20;
  EXPECT_TRUE(says(refusal(pressed(kSoft, creeping)), "speeds are too alike"))
      << refusal(pressed(kSoft, creeping));
  for (PressSample& s : backwards) s.rate = -s.rate;
  EXPECT_TRUE(says(refusal(backwards), "gives back more")) << refusal(backwards);
}

}  // namespace
}  // namespace palpa::calibration

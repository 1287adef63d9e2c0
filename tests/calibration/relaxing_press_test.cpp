#include "calibration/touch/relaxing_press.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "anatomy/base/random.h"
#include "complaint.h"

/// Presses of a thing that relaxes. What relaxes here does so over one time, and over another than
/// those of the estimator's series.
namespace palpa::calibration {
namespace {

constexpr double kDt = 1e-3, kDepth = 3e-3;

struct Pressing {
  double f_d = 0.4, m = 1.4, x0 = 2e-4;  ///< at 3 mm
  double down = 0.3, hold = 0.1, up = 0.3, deepest = 4e-3;
};

double eased(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10 + u * (6 * u - 15));
}

/// f = E + q, dq/dt = share dE/dt - q / time, in steps of a fifth of a millisecond.
std::vector<PressSample> pressed(const Pressing& p, double share, double time,
                                 RandomStream& noise) {
  constexpr int kFine = 5;
  std::vector<PressSample> samples;
  double q = 0, before = 0;
  const double total = p.down + p.hold + p.up + 0.1;
  for (int i = 0; i * kDt < total; ++i) {
    double x = 0;
    for (int j = 0; j < kFine; ++j) {
      const double t = (i + (j + 1.0) / kFine) * kDt;
      x = p.x0 - 5e-4 +
          (p.deepest + 5e-4) * (eased(t / p.down) - eased((t - p.down - p.hold) / p.up));
      const double E = x > p.x0 ? p.f_d * std::pow((x - p.x0) / kDepth, p.m) : 0;
      q += share * (E - before) - q * kDt / kFine / time;
      before = E;
    }
    samples.push_back({x, 0, std::max(before + q, 0.0) + 0.004 * noise.normal()});
  }
  return samples;
}

std::vector<std::vector<PressSample>> severalHeld(double share, double time, RandomStream& noise) {
  std::vector<std::vector<PressSample>> all;
  for (int i = 0; i < 8; ++i)
    all.push_back(pressed({.f_d = 0.3 + 0.05 * i, .down = 0.15 + 0.05 * (i % 4), .hold = 0.6},
                          share, time, noise));
  return all;
}

/// Of ln f_d over some presses, on average.
double meanError(const Relaxation& law, double share, double time, RandomStream& noise) {
  constexpr int kPresses = 12;
  double sum = 0;
  for (int i = 0; i < kPresses; ++i)
    sum += std::log(
        identifyElastic(pressed({.f_d = 0.5, .down = 0.2 + 0.03 * i}, share, time, noise), kDt, law)
            .f_d /
        0.5);
  return sum / kPresses;
}

TEST(RelaxingPress, WhatRelaxesIsTakenOffAsWellAsItSays) {
  int within = 0;
  constexpr int kSamples = 6;
  double plain = 0;
  for (int seed = 1; seed <= kSamples; ++seed) {
    RandomStream noise(static_cast<std::uint64_t>(seed), "relaxing_press_test");
    const FoundRelaxation found = identifyRelaxation(severalHeld(0.15, 0.1, noise), kDt);
    EXPECT_LT(found.shared_sd, 0.05);
    within += std::abs(meanError(found.law, 0.15, 0.1, noise)) < 2.5 * found.shared_sd;
    plain += meanError(Relaxation{}, 0.15, 0.1, noise) / kSamples;
  }
  EXPECT_GE(within, 5);
  EXPECT_GT(plain, 0.04) << "what not knowing of it costs";
}

TEST(RelaxingPress, SaysHowWellItKnows) {
  RandomStream noise(2, "relaxing_press_test");
  int within = 0;
  constexpr int kPresses = 100;
  for (int i = 0; i < kPresses; ++i) {
    const ElasticPress found = identifyElastic(pressed({}, 0, 1, noise), kDt, Relaxation{});
    within += std::abs(std::log(found.f_d / 0.4)) < 1.96 * found.sd;
    EXPECT_GE(found.deepest, kDepth);
  }
  EXPECT_GE(within, 88);  // of 95 expected; 88 or fewer happen once in 300 times
}

TEST(RelaxingPress, WhatDoesNotRelaxHasNoShares) {
  RandomStream noise(3, "relaxing_press_test");
  for (const double share : identifyRelaxation(severalHeld(0, 1, noise), kDt).law.share)
    EXPECT_LT(share, 0.04);
}

TEST(RelaxingPress, ForceOfAHeldPressFallsToTheElasticOne) {
  const Relaxation law{{0.1, 0.2, 0.3}};
  const std::vector<double> f = relaxed(law, std::vector<double>(30'000, 2.0), kDt);
  EXPECT_NEAR(f.front(), 2 * 1.6, 0.01);
  EXPECT_NEAR(f.back(), 2, 1e-3);
}

TEST(RelaxingPress, RefusesWhatTellsNothing) {
  RandomStream noise(4, "relaxing_press_test");
  const auto refusal = [](const std::vector<PressSample>& press) {
    return test::complaint([&] { identifyElastic(press, kDt, Relaxation{}); });
  };
  EXPECT_TRUE(test::says(refusal(pressed({.f_d = 0.02}, 0, 1, noise)), "too light"));
  EXPECT_TRUE(test::says(refusal(pressed({.down = 0.03, .hold = 0, .up = 0.03}, 0, 1, noise)),
                         "too short"));
  auto press = pressed({}, 0, 1, noise);
  press[100].f = std::nan("");
  EXPECT_TRUE(test::says(refusal(press), "figures that are none"));
  EXPECT_TRUE(test::says(test::complaint([&] { identifyRelaxation({press}, kDt); }), "1 presses"));
}

}  // namespace
}  // namespace palpa::calibration

#include "haptics/materials/force_laws.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpa::haptics {
namespace {

Relaxation tissue() {
  Relaxation law;
  law.g[0] = 0.25, law.tau[0] = 0.05;
  law.g[1] = 0.15, law.tau[1] = 1.2;
  return law;
}

TEST(Relaxation, AStepFallsAsTheSeriesSays) {
  const Relaxation law = tissue();
  RelaxationState state;
  relaxed(law, state, 2, 1e-9);  // a step: at once
  for (int k = 1; k <= 5000; ++k) {
    const double t = k * 1e-3, f = relaxed(law, state, 2, 1e-3);
    const double G = 1 - 0.25 - 0.15 + 0.25 * std::exp(-t / 0.05) + 0.15 * std::exp(-t / 1.2);
    ASSERT_NEAR(f, 2 * G, 1e-6) << t;
  }
}

/// The integral over a ramp, in closed form: r (g_inf t + sum g tau (1 - exp(-t/tau))).
TEST(Relaxation, ARampIsExactAtAnyStep) {
  const Relaxation law = tissue();
  for (const double dt : {0.25e-3, 1e-3, 7e-3, 0.1}) {
    RelaxationState state;
    for (double t = dt; t < 2; t += dt) {
      const double f = relaxed(law, state, 3 * t, dt);
      const double expected = 3 * (0.6 * t + 0.25 * 0.05 * (1 - std::exp(-t / 0.05)) +
                                   0.15 * 1.2 * (1 - std::exp(-t / 1.2)));
      ASSERT_NEAR(f, expected, 1e-9) << dt << " " << t;
    }
  }
}

TEST(Relaxation, NoTermsAndLostContactLeaveNothing) {
  RelaxationState state;
  EXPECT_EQ(relaxed({}, state, 1.5, 1e-3), 1.5);
  const Relaxation law = tissue();
  relaxed(law, state, 1.5, 1e-3);
  EXPECT_EQ(relaxed(law, state, 0, 1e-3), 0);
  EXPECT_EQ(state.held[0], 0);
  EXPECT_EQ(state.elastic, 0);
}

TEST(Relaxation, NeverPullsAndNeverGrowsBeyondElastic) {
  const Relaxation law = tissue();
  RelaxationState state;
  for (int k = 0; k < 20'000; ++k) {
    const double elastic = std::max(2 * std::sin(k * 0.013) + std::sin(k * 0.0031), 0.0);
    const double f = relaxed(law, state, elastic, 1e-3);
    ASSERT_GE(f, 0);
    ASSERT_LT(f, 3.1);
  }
}

}  // namespace
}  // namespace palpa::haptics

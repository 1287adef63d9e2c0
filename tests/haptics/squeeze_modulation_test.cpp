#include "haptics/modulation/modulation.h"

#include <gtest/gtest.h>

#include "anatomy/base/random.h"
#include "tests/support/allocation_count.h"

namespace palpa::haptics {
namespace {

constexpr double kWidth = 0.05;  // m
const HuntCrossley kFoam{3000, 0, 1.3};

/// An object held between two tools, its axis tilted from the horizontal, squeezed by `depth` at
/// each side. Each tool carries half of the weight.
struct Held {
  std::array<Vec3, 2> f_r, p;
  double F = 0;
};
Held held(double depth, double weight_N, double tilt, bool swapped = false) {
  const Vec3 axis(std::cos(tilt), 0, std::sin(tilt));
  Held h;
  h.F = forceOf(kFoam, depth, 0);
  for (int i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1 : -1;
    h.p[static_cast<std::size_t>(i)] = side * (0.5 * kWidth - depth) * axis;
    h.f_r[static_cast<std::size_t>(i)] = side * h.F * axis - Vec3(0, 0, 0.5 * weight_N);
  }
  if (swapped) {
    std::swap(h.f_r[0], h.f_r[1]);
    std::swap(h.p[0], h.p[1]);
  }
  return h;
}

/// The state as it is where both tools have just come to touch.
SqueezeState touched() { return {kWidth}; }

TEST(SqueezeModulation, TheSqueezeIsFoundWhateverTheWeightTheTiltAndTheOrder) {
  for (const double tilt_deg : {0.0, 30.0, 60.0})
    for (const double weight : {0.0, 1.0})
      for (const bool swapped : {false, true})
        for (const double factor : {0.5, 0.75, 1.5, 2.0}) {
          SqueezeState state = touched();
          const double tilt = tilt_deg * 3.14159265358979 / 180;
          const Held h = held(0.008, weight, tilt, swapped);
          const Squeezed s = modulateSqueeze({{0, factor}, 1, 0.1}, h.f_r, h.p, &state);
          ASSERT_TRUE(s.contact);
          EXPECT_NEAR(s.F, h.F, 1e-9);
          EXPECT_NEAR(s.x, 0.008, 1e-12);
          for (std::size_t i = 0; i < 2; ++i) {
            const Vec3 u = h.p[i].normalized(), felt = h.f_r[i] + s.f_d[i];
            EXPECT_LT((felt - (factor * h.F * u - Vec3(0, 0, 0.5 * weight))).norm(), 1e-9)
                << "the weight stays";
            EXPECT_LT((s.f_w[i] - Vec3(0, 0, -0.5 * weight)).norm(), 1e-9);
          }
        }
}

TEST(SqueezeModulation, AConstantStiffnessIsASpringAtEachSide) {
  SqueezeState state = touched();
  for (const double depth : {0.002, 0.005, 0.01}) {
    const Held h = held(depth, 0.6, 0.4);
    const Squeezed s = modulateSqueeze({{900, 1}, 1, 0.1}, h.f_r, h.p, &state);
    EXPECT_NEAR((h.f_r[0] + s.f_d[0] - s.f_w[0]).norm(), 900 * depth, 1e-9);
  }
}

/// A soft thing is deep when it is felt first: where it begins is told by its law, or everything is
/// felt too soft.
TEST(SqueezeModulation, BeginsWhereTheSurfacesAreNotWhereTheyAreFelt) {
  SqueezeModulation law;
  law.real = kFoam;
  law.target.constant = 400;
  SqueezeState state;
  Squeezed now;
  for (double depth = 0; depth < 0.006; depth += 1e-5) {
    const Held h = held(depth, 0, 0);
    now = modulateSqueeze(law, h.f_r, h.p, &state);
  }
  EXPECT_NEAR(now.x, 0.006, 2e-5);
  EXPECT_NEAR(state.d0, kWidth, 2e-5);
}

/// Of a soft thing that is hardly touched the force says little of how deep it is pressed: what
/// comes later says it better.
TEST(SqueezeModulation, TheNoiseOfTheFirstTouchIsForgotten) {
  SqueezeModulation law;
  law.real = {600, 0, 1.35};
  law.x0 = 3e-4;
  SqueezeState state;
  RandomStream noise(7, "squeeze");
  double at_first = 0, now = 0;
  for (int i = 1; i < 700; ++i) {
    const double depth = 1e-5 * i, F = forceOf(law.real, depth - law.x0, 0) + 0.02 * noise.normal();
    Held h = held(depth, 0, 0);
    for (Vec3& f : h.f_r) f = std::max(F, 0.0) * f.normalized();
    const Squeezed s = modulateSqueeze(law, h.f_r, h.p, &state);
    now = std::abs(s.x - depth);
    if (s.contact && at_first == 0) at_first = now;
  }
  EXPECT_GT(at_first, 2e-4);
  EXPECT_LT(now, 0.2 * at_first);
}

TEST(SqueezeModulation, HeavierAndLighter) {
  for (const double factor : {0.0, 2.0, 3.0}) {
    SqueezeState state = touched();
    const Held h = held(0.006, 1, 0.5);
    const Squeezed s = modulateSqueeze({{}, factor, 0.1}, h.f_r, h.p, &state);
    const Vec3 carried = h.f_r[0] + s.f_d[0] + h.f_r[1] + s.f_d[1];
    EXPECT_LT((carried - Vec3(0, 0, -factor)).norm(), 1e-9) << factor;
  }
}

TEST(SqueezeModulation, BeginsWhereBothTouchAndEndsWhereOneDoesNot) {
  SqueezeState state;
  Held h = held(0.001, 0, 0);
  modulateSqueeze({{0, 2}, 1, 0.1}, h.f_r, h.p, &state);
  EXPECT_NEAR(state.d0, kWidth - 0.002, 1e-12);
  h.f_r[1] = Vec3(0, 0, 0.01);
  const Squeezed s = modulateSqueeze({{0, 2}, 1, 0.1}, h.f_r, h.p, &state);
  EXPECT_FALSE(s.contact);
  EXPECT_EQ(s.f_d[0], Vec3::Zero());
  EXPECT_EQ(state.d0, 0);
}

TEST(SqueezeModulation, NonsenseGivesNothingAndNothingAllocates) {
  SqueezeState state = touched();
  const Held good = held(0.004, 1, 0.2);
  Held bad = good, one = good;
  bad.f_r[0].x() = std::nan("");
  one.p[1] = one.p[0];
  const NoAllocation guard;
  const Squeezed from_bad = modulateSqueeze({{0, 2}, 2, 0.1}, bad.f_r, bad.p, &state),
                 from_one = modulateSqueeze({{0, 2}, 2, 0.1}, one.f_r, one.p, &state);
  modulateSqueeze({{0, 2}, 2, 0.1}, good.f_r, good.p, &state);
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_EQ(from_bad.f_d[0] + from_bad.f_d[1] + from_one.f_d[0] + from_one.f_d[1],
            Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace palpa::haptics

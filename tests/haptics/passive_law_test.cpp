#include "haptics/safety/passive_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

#include "haptics/augmentation/augmentation.h"

/// What is said of a law before it begins, against the law in a loop.
namespace palpa::haptics {
namespace {

constexpr double kPi = std::numbers::pi;

/// A mass on an ideal spring, which rings at `f` Hz, and a law that answers its place once a
/// period, late. It begins 1 mm off; says by how much it has grown after two seconds.
template <typename Law>
double growth(double f, double mass, double damping, const LoopDelay& delay, Law law) {
  constexpr int kSubsteps = 100;
  const auto late = static_cast<std::size_t>(std::llround(delay.beyond_s / delay.period_s));
  const double w = 2 * kPi * f, h = delay.period_s / kSubsteps;
  double x = 1e-3, v = 0, first = 0, last = 0;
  std::deque<double> forces(late, 0.0);
  const int ticks = static_cast<int>(2 / delay.period_s);
  for (int k = 0; k < ticks; ++k) {
    forces.push_back(law(x));
    const double f_law = forces.front();
    forces.pop_front();
    for (int i = 0; i < kSubsteps; ++i) {
      v += (-mass * w * w * x - damping * v + f_law) / mass * h;
      x += v * h;
    }
    const double size = std::hypot(x, v / w);
    if (k < ticks / 10) first = std::max(first, size);
    if (k >= ticks - ticks / 10) last = std::max(last, size);
  }
  return last / first;
}

/// Where the damping that is said is needed: three quarters of a turn late, about.
double worstFrequency(const LoopDelay& delay) {
  double worst = 0, least = 0;
  for (double f = 1; f < 0.5 / delay.period_s; f += 0.5) {
    const double w = 2 * kPi * f, at = std::sin(w * (delay.beyond_s + delay.period_s / 2)) /
                                       std::sin(w * delay.period_s / 2);
    if (at < least) {
      least = at;
      worst = f;
    }
  }
  return worst;
}

TEST(PassiveLaw, ASpringThatIsTakenNeedsTheDampingThatIsSaid) {
  constexpr double kStiff = 400;
  for (const double late : {0.003, 0.008}) {
    const LoopDelay delay{1e-3, late};
    const double need = dampingForTaken(kStiff, delay), f = worstFrequency(delay);
    ASSERT_GT(need, 0.05);
    const auto taken = [](double x) { return kStiff * x; };
    // the object's own spring, as stiff as what is taken, is part of what rings
    EXPECT_GT(growth(f, 0.1, 0.7 * need, delay, taken), 1.2) << late;
    EXPECT_LT(growth(f, 0.1, 1.3 * need, delay, taken), 0.8) << late;
  }
}

/// sin(u)/u at its least, u = 4.4934.
TEST(PassiveLaw, ALongDelayNeedsAFifthOfWhatASpringNeeds) {
  const LoopDelay delay{1e-3, 0.05};
  EXPECT_NEAR(dampingForTaken(1000, delay) / (1000 * 0.0505), 0.2172, 0.002);
}

TEST(PassiveLaw, InTimeNothingIsNeeded) {
  EXPECT_EQ(dampingForTaken(1000, {1e-3, 0}), 0);
  EXPECT_NEAR(dampingForTaken(1000, {1e-3, 1e-3}), 0.5, 1e-3);  // at half the rate: -T/2
}

TEST(PassiveLaw, TheLargestThatMayBeTakenIsWhatDeviceAndHandBear) {
  DeviceCapabilities device;
  device.viscous_damping = 0.2;
  device.delay = 0.002;
  const LoopDelay delay{1e-3, 0.005};
  const double most = largestTaken(device, delay);
  EXPECT_NEAR(dampingForTaken(most, {1e-3, 0.007}), 0.2 + kLightestGrip, 1e-9);
  device.coulomb_friction = 0.06;
  device.position_resolution = 23e-6;
  EXPECT_EQ(largestTaken(device, delay), std::min(most, 2 * 0.06 / 23e-6));
  EXPECT_EQ(largestTaken(device, {0, 0.001}), 0);  // no loop
  EXPECT_LT(largestTaken(device, {1e-3, 0.02}), most);
}

AugmentationPlan steadyingPlan(double c) {
  AugmentationPlan plan;
  plan.count = 1;
  plan.largest = 1e9;
  Augmentation& a = plan.each[0];
  a.kind = AugmentationKind::steadying;
  a.amplitude = c;
  a.from_Hz = 8;
  a.to_Hz = 12;
  a.blend_s = 0;
  return plan;
}

/// The band as the tick has it.
class SteadyingLaw {
 public:
  explicit SteadyingLaw(double c) : plan_(steadyingPlan(c)) {}
  double operator()(double x) {
    AugmentationInput in;
    in.dp = Vec3(started_ ? x - x_ : 0, 0, 0);
    x_ = x;
    started_ = true;
    return augment(plan_, in, &state_).f.x();
  }

 private:
  AugmentationPlan plan_;
  AugmentationState state_;
  double x_ = 0;
  bool started_ = false;
};

TEST(PassiveLaw, ABandIsBoundedByItsDelay) {
  const LoopDelay delay{1e-3, 0.012};
  DeviceCapabilities device;
  device.viscous_damping = 0.2;
  const DampedBand band{8, 12, 20};
  const double need = dampingForBand(band, delay);
  EXPECT_NEAR(largestBandDamping(band, device, delay) * need / 20, 2.2, 1e-9);
  EXPECT_GT(need, dampingForBand(band, {1e-3, 0.002}));
  double grown = 0, calm = 0;  // over all frequencies at which a hand may ring
  for (double f = 4; f < 60; f += 2) {
    SteadyingLaw less(band.damping), more(band.damping);
    grown = std::max(grown, growth(f, 0.2, 0.5 * need, delay, less));
    calm = std::max(calm, growth(f, 0.2, 1.2 * need, delay, more));
  }
  EXPECT_GT(grown, 1.2);
  EXPECT_LT(calm, 1);
}

TEST(PassiveLaw, ABandSaysHowLateItIs) {
  const DampedBand band{8, 12, 20};
  const LoopDelay delay{1e-3, 0.001};
  EXPECT_NEAR(bandDelay(band, delay, std::sqrt(96.0)), 0.002, 1e-4);  // loop and drives alone
  EXPECT_LT(bandDelay(band, delay, 8), 0);
  EXPECT_GT(bandDelay(band, delay, 12), 0.01);
  EXPECT_NEAR(bandSettling(band), 1 / (kPi * 4), 1e-12);  // 80 ms: half the band's width
}

}  // namespace
}  // namespace palpa::haptics

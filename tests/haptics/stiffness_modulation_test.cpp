#include "haptics/modulation/modulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/allocation_count.h"

namespace palpa::haptics {
namespace {

constexpr double kModulationTick = 1e-3;
const HuntCrossley kSilicone{2000, 1500, 1.4};
const Dahl kSkinned{0.6, 3000, 0.5};
const Vec3 kTilted = Vec3(0.3, -0.2, 1).normalized();

/// A tool that presses a tilted plane and strokes along it, and what the plane gives back: the
/// normal force of the elastic law with its damping, friction by Dahl's differential form in small
/// parts.
struct Stroke {
  double t = 0, x = 0, rate = 0, along = 0, F = 0, speed = 0;
  Vec3 dp = Vec3::Zero(), f_r = Vec3::Zero();

  void step(double depth, double press_Hz, double stroke_m, double stroke_Hz) {
    const Vec3 tangent = kTilted.cross(Vec3::UnitX()).normalized();
    const double x_before = x, along_before = along;
    t += kModulationTick;
    x = depth * 0.5 * (1 - std::cos(2 * std::numbers::pi * press_Hz * t));
    rate = (x - x_before) / kModulationTick;
    along = stroke_m * std::sin(2 * std::numbers::pi * stroke_Hz * t);
    speed = (along - along_before) / kModulationTick;
    const double f_n = x > 0 ? std::pow(x, kSilicone.m) * (kSilicone.k + kSilicone.b * rate) : 0,
                 limit = kSkinned.mu * f_n;
    constexpr int kParts = 50;
    const double part = (along - along_before) / kParts;
    for (int i = 0; i < kParts && limit > 0; ++i)
      F = std::clamp(F + kSkinned.sigma * part * (1 - F / limit * (part > 0 ? 1 : -1)), -limit,
                     limit);
    if (!(limit > 0)) F = 0;
    dp = -(x - x_before) * kTilted + (along - along_before) * tangent;
    f_r = f_n * kTilted - (F + (limit > 0 ? kSkinned.B * speed : 0)) * tangent;
  }
  double f_n() const { return f_r.dot(kTilted); }
};

StiffnessModulation lawFor(const TargetStiffness& target) {
  return {kSilicone, 0, kSkinned, target, 0.1};
}

TEST(StiffnessModulation, WhereTheTargetIsTheTruthTheDeviceStaysQuiet) {
  StiffnessModulationState state;
  Stroke stroke;
  for (int i = 0; i < 3000; ++i) {
    stroke.step(0.010, 1.3, 0.02, 0.7);
    EXPECT_LT(
        modulateStiffness(lawFor({}), stroke.f_r, stroke.dp, kModulationTick, &state).f_d.norm(),
        1e-9);
  }
}

/// Pressing straight down is no stroke, even where the reaction at first touch was askew: the
/// normal does not run off to the side.
TEST(StiffnessModulation, PressingMakesNoFriction) {
  StiffnessModulationState state;
  const HuntCrossley soft{150, 0, 1};
  Modulated now;
  for (double x = 1e-5; x < 0.007; x += 1e-5) {
    const double f_n = forceOf(soft, x, 0);
    now = modulateStiffness({soft, 0, {0.35, 1500, 0.4}, {}, 0.1}, Vec3(0.02 * f_n, 0, f_n),
                            Vec3(0, 0, -1e-5), kModulationTick, &state);
  }
  EXPECT_NEAR(std::atan2(now.u_n.x(), now.u_n.z()), 0.02, 0.005);
}

/// Pressing and stroking at once: the normal is found though friction pulls aside by up to 31
/// degrees, and the hand feels the factor.
TEST(StiffnessModulation, HarderAndSofterWhilePressingAndStroking) {
  for (const double factor : {0.5, 0.75, 1.5, 2.0}) {
    StiffnessModulationState state;
    Stroke stroke;
    double off2 = 0, felt2 = 0, angle2 = 0;
    int n = 0;
    for (int i = 0; i < 4000; ++i) {
      stroke.step(0.010, 1.3, 0.02, 0.7);
      const Modulated m =
          modulateStiffness(lawFor({0, factor}), stroke.f_r, stroke.dp, kModulationTick, &state);
      if (stroke.f_n() < 0.3) continue;
      ASSERT_TRUE(m.contact);
      const double wanted = factor * stroke.f_n(), felt = (stroke.f_r + m.f_d).dot(kTilted);
      off2 += std::pow(felt - wanted, 2);
      felt2 += wanted * wanted;
      angle2 += std::pow(std::acos(std::min(m.u_n.dot(kTilted), 1.0)), 2);
      ++n;
    }
    ASSERT_GT(n, 1000);
    EXPECT_LT(std::sqrt(off2 / felt2), 0.02) << factor;  // what the start of each stroke leaves
    EXPECT_LT(std::sqrt(angle2 / n), 0.05)
        << factor;  // rad; without friction's part taken off it would be 0.5
  }
}

/// A constant stiffness: the hand feels k~ x, whatever the real law's exponent.
TEST(StiffnessModulation, AConstantStiffnessIsASpring) {
  StiffnessModulationState state;
  Stroke stroke;
  for (int i = 0; i < 2000; ++i) {
    stroke.step(0.008, 1.1, 0, 0);
    const Modulated m =
        modulateStiffness(lawFor({700, 1}), stroke.f_r, stroke.dp, kModulationTick, &state);
    if (stroke.f_n() < 0.3) continue;
    EXPECT_NEAR(m.x, stroke.x, 1e-6);
    EXPECT_NEAR((stroke.f_r + m.f_d).dot(kTilted), 700 * stroke.x, 1e-3);
  }
}

/// The friction that is felt is the real one: what the device adds lies along the normal.
TEST(StiffnessModulation, LeavesFrictionAlone) {
  StiffnessModulationState state;
  Stroke stroke;
  for (int i = 0; i < 2000; ++i) {
    stroke.step(0.010, 0.9, 0.02, 0.7);
    const Modulated m =
        modulateStiffness(lawFor({0, 2}), stroke.f_r, stroke.dp, kModulationTick, &state);
    EXPECT_LT((m.f_d - m.f_d.dot(m.u_n) * m.u_n).norm(), 1e-12);
  }
}

TEST(StiffnessModulation, NothingWithoutContactAndNothingFromNonsense) {
  StiffnessModulationState state;
  const StiffnessModulation law = lawFor({0, 2});
  EXPECT_EQ(modulateStiffness(law, {0, 0, 0.05}, Vec3::Zero(), kModulationTick, &state).f_d,
            Vec3::Zero());
  EXPECT_GT(modulateStiffness(law, {0, 0, 1}, Vec3::Zero(), kModulationTick, &state).f_d.norm(),
            0.5);
  for (const Vec3& f_r : {Vec3(std::nan(""), 0, 1), Vec3(0, INFINITY, 0)}) {
    EXPECT_EQ(modulateStiffness(law, f_r, Vec3::Zero(), kModulationTick, &state).f_d, Vec3::Zero());
    EXPECT_EQ(state.f_n, 0);
  }
  EXPECT_EQ(modulateStiffness(law, {0, 0, 1}, Vec3::Zero(), 0, &state).f_d, Vec3::Zero());
}

TEST(StiffnessModulation, NeverAllocates) {
  StiffnessModulationState state;
  const NoAllocation guard;
  for (int i = 0; i < 1000; ++i)
    modulateStiffness(lawFor({0, 2}), {0.1, 0, 1}, {1e-6, 0, -1e-6}, kModulationTick, &state);
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace palpa::haptics

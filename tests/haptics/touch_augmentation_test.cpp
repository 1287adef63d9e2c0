#include "haptics/modulation/touch_augmentation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "anatomy/geometry/top_shape.h"
#include "tests/support/allocation_count.h"

namespace palpa::haptics {
namespace {

constexpr double kTouchTick = 1e-3;
const HuntCrossley kTouched{900, 300, 1.4};
const Dahl kTouchedSurface{0.35, 1500, 0.4};

const VirtualInclusion kLumpOf{
    0.014,
    {8000, 0, 1.9},
    {HuntCrossley{600, 0, 1}, HuntCrossley{600, 0, 1}, HuntCrossley{300, 0, 1.1}}};

TouchAugmentation lumpy() {
  TouchAugmentation law;
  law.surface.contact = {kTouched, 0, kTouchedSurface, {}, 0.1};
  law.surface.wanted = kTouchedSurface;
  law.kinds[2] = kLumpOf;
  law.tip_radius = 0.008;
  return law;
}

PlacedLumps placed(int count) {
  PlacedLumps lumps;
  for (int i = 0; i < count; ++i) lumps[static_cast<std::size_t>(i)] = {{0.03 * i, 0, -0.014}, 3};
  return lumps;
}

/// A tool pressed straight down at `x`, as deep as `depth`.
ToolTouch pressed(double x, double depth, double rate = 0) {
  return {true, Vec3(x, 0, 0.008 - depth), Vec3(0, 0, forceOf(kTouched, depth, rate))};
}

/// Pressed slowly to `depth` at `places`; the last answer.
AugmentedTouch pressedTo(const TouchAugmentation& law, int lumps, double depth,
                         const std::array<double, 2>& places, bool second) {
  TouchAugmentationState state;
  AugmentedTouch now;
  for (double x = 0; x < depth; x += 1e-5) {
    std::array<ToolTouch, 2> tools{pressed(places[0], x, 0.01), pressed(places[1], x, 0.01)};
    tools[1].present = second;
    now = augmentTouch(law, placed(lumps), tools, kTouchTick, &state);
  }
  return now;
}

TEST(TouchAugmentation, WithoutLumpsAndChangesTheDevicesStayQuiet) {
  const AugmentedTouch now = pressedTo(lumpy(), 0, 0.006, {0, 0.02}, true);
  EXPECT_TRUE(now.touch[0].contact && now.touch[1].contact);
  EXPECT_LT(now.f_d[0].norm() + now.f_d[1].norm(), 1e-9);
}

/// A tool feels the lump below it as the lump's own law has it; a second lump that is far away adds
/// little, a second tool on it feels the same mirrored.
TEST(TouchAugmentation, EveryToolFeelsItsLump) {
  const AugmentedTouch one = pressedTo(lumpy(), 1, 0.006, {0, 0.03}, false),
                       both = pressedTo(lumpy(), 2, 0.006, {0, 0.03}, true);
  EXPECT_GT(one.f_d[0].z(), 0.1);
  EXPECT_LT(one.d[0][2], -0.5e-3);
  EXPECT_EQ(one.f_d[1], Vec3(Vec3::Zero()));
  EXPECT_NEAR(both.f_d[0].z(), both.f_d[1].z(), 1e-4);
  EXPECT_NEAR(both.f_d[0].x(), -both.f_d[1].x(), 1e-4);
  EXPECT_NEAR(both.f_d[0].z(), one.f_d[0].z(), 0.15 * one.f_d[0].z());
  EXPECT_LE(both.iterations, kMostLumps * kMostInclusionIterations);
}

/// Below a slope a lump is felt as below a level top: all of it is turned, bed included.
TEST(TouchAugmentation, ALumpBelowASlopeIsTheSameTurned) {
  TouchAugmentation law = lumpy();
  const Vec3 n = Vec3(0.3, -0.4, 1).normalized(), place(0.02, 0.01, -0.005);
  const Mat3 R = turnToNormal(n);
  PlacedLumps level = placed(1), sloping = level;
  sloping[0].p_T0 = pack(Vec3(place + R * unpack(level[0].p_T0)));
  for (std::size_t i = 0; i < 3; ++i)
    sloping[0].n[i] = static_cast<float>(n[static_cast<Eigen::Index>(i)]);
  TouchAugmentationState a, b;
  AugmentedTouch on_level, on_slope;
  for (double x = 0; x < 0.006; x += 1e-5) {
    const ToolTouch tool = pressed(0.004, x, 0.01);
    ToolTouch turned = tool;
    turned.p_M = place + R * tool.p_M;
    turned.f_r = R * tool.f_r;
    on_level = augmentTouch(law, level, {tool, {}}, kTouchTick, &a);
    on_slope = augmentTouch(law, sloping, {turned, {}}, kTouchTick, &b);
  }
  EXPECT_GT(on_level.f_d[0].norm(), 0.1);
  EXPECT_LT((on_slope.f_d[0] - R * on_level.f_d[0]).norm(), 1e-5) << "n is kept as floats";
  EXPECT_LT((unpack(on_slope.d[0]) - unpack(on_level.d[0])).norm(), 1e-7);
  sloping[0].n = {0, 0, 1};
  b = {};
  for (double x = 0; x < 0.006; x += 1e-5) {
    ToolTouch turned = pressed(0.004, x, 0.01);
    turned.p_M = place + R * turned.p_M;
    turned.f_r = R * turned.f_r;
    on_slope = augmentTouch(law, sloping, {turned, {}}, kTouchTick, &b);
  }
  EXPECT_GT((on_slope.f_d[0] - R * on_level.f_d[0]).norm(), 1e-3) << "its bed is not round";
}

/// Stiffness and lump are added, not multiplied.
TEST(TouchAugmentation, StiffnessAndLumpAddUp) {
  TouchAugmentation hard = lumpy();
  hard.surface.contact.target.factor = 2;
  const AugmentedTouch soft = pressedTo(lumpy(), 1, 0.006, {0, 0.03}, false),
                       harder = pressedTo(hard, 1, 0.006, {0, 0.03}, false);
  EXPECT_NEAR(harder.f_d[0].z() - soft.f_d[0].z(), soft.touch[0].f_n, 1e-6);
}

TEST(TouchAugmentation, AToolThatIsNotThereOrTellsNonsenseIsForgotten) {
  const NoAllocation none;
  TouchAugmentationState state;
  AugmentedTouch now;
  for (int i = 0; i < 200; ++i)
    now = augmentTouch(lumpy(), placed(2), {pressed(0, 0.006), pressed(0.03, 0.006)}, kTouchTick,
                       &state);
  ToolTouch lost = pressed(0, 0.006);
  lost.p_M.x() = NAN;
  now = augmentTouch(lumpy(), placed(2), {lost, pressed(0.03, 0.006)}, kTouchTick, &state);
  EXPECT_EQ(now.f_d[0], Vec3(Vec3::Zero()));
  EXPECT_GT(now.f_d[1].z(), 0.1);
  EXPECT_EQ(state.held[0], 0u);
  lost = pressed(0, 0.006);
  lost.f_r.z() = INFINITY;
  PlacedLumps nonsense = placed(2);
  nonsense[0].p_T0[1] = NAN;
  nonsense[1].kind = 77;
  now = augmentTouch(lumpy(), nonsense, {lost, pressed(0.03, 0.006)}, kTouchTick, &state);
  EXPECT_EQ(now.f_d[1], now.touch[1].f_d);
  EXPECT_EQ(now.f_d[0], Vec3(Vec3::Zero()));
  EXPECT_EQ(none.allocations(), 0);
}

/// A tool that rubs along x over a real surface with Dahl's friction, pressed with 1 N.
struct Rubbing {
  explicit Rubbing(double times_as_rough) : factor(times_as_rough) {
    law.other_friction = 1;
    for (int i = 0; i < 20; ++i) move(0);
  }
  /// What the hand feels in this tick, real and added.
  Vec3 move(double dx) {
    x += dx;
    f_r = Vec3(0, 0, 1) -
          dragOf(kTouchedSurface, Vec3(dx, 0, 0), Vec3::UnitZ(), 1, kTouchTick, &real);
    const AugmentedTouch now =
        augmentTouch(law, {}, {{{true, Vec3(x, 0, 0.004), f_r, factor}, {}}}, kTouchTick, &state);
    return f_r + now.f_d[0];
  }

  double factor, x = 0;
  TouchAugmentation law = lumpy();
  DahlState real;
  TouchAugmentationState state;
  Vec3 f_r = Vec3::Zero();
};

TEST(TouchAugmentation, TimesTheFrictionIsFeltOnceItSlides) {
  constexpr double kSpeed = 0.05;  // m/s
  const double once = kTouchedSurface.mu + kTouchedSurface.B * kSpeed;
  for (const double factor : {0.0, 0.5, 1.0, 2.0, 3.0}) {
    Rubbing rubbing(factor);
    Vec3 felt = Vec3::Zero();
    for (int i = 0; i < 400; ++i) felt = rubbing.move(kSpeed * kTouchTick);
    EXPECT_NEAR(felt.x(), -factor * once, 1e-6) << factor;
    EXPECT_NEAR(felt.z(), 1, 1e-6) << "pressing feels as it does";
  }
}

TEST(TouchAugmentation, OnceTheFrictionIsTheRealOneBeforeItSlidesToo) {
  Rubbing rubbing(1);
  for (int i = 0; i < 300; ++i) {
    const Vec3 felt = rubbing.move(i % 100 < 50 ? 4e-6 : -4e-6);
    EXPECT_LT((felt - rubbing.f_r).norm(), 1e-9);
  }
}

TEST(TouchAugmentation, AFactorThatIsNoneIsOne) {
  for (const double none : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    Rubbing wrong(none), once(1);
    Vec3 felt = Vec3::Zero(), real = Vec3::Zero();
    for (int i = 0; i < 50; ++i) felt = wrong.move(2e-5), real = once.move(2e-5);
    EXPECT_EQ(felt, real) << none;
  }
}

TEST(TouchAugmentation, OffContactAFactorAddsNothingAndIsForgotten) {
  Rubbing rubbing(2);
  for (int i = 0; i < 50; ++i) rubbing.move(5e-5);
  const NoAllocation none;
  const AugmentedTouch off =
      augmentTouch(rubbing.law, {}, {{{true, Vec3(rubbing.x, 0, 0.01), Vec3(0, 0, 0.01), 2.0}, {}}},
                   kTouchTick, &rubbing.state);
  EXPECT_EQ(off.f_d[0], Vec3(Vec3::Zero()));
  EXPECT_EQ(rubbing.state.surface[0].wanted.F, (Packed3{0, 0, 0}));
  EXPECT_EQ(none.allocations(), 0);
}

/// To and fro along the same way, wide and narrow: the hand never gets more than it gave.
TEST(TouchAugmentation, AClosedStrokeGivesTheHandNoEnergy) {
  for (const double factor : {0.0, 0.5, 1.0, 2.0})
    for (const int steps : {20, 1000}) {
      Rubbing rubbing(factor);
      double given_J = 0;
      for (int loop = 0; loop < 5; ++loop) {
        if (loop == 1) given_J = 0;  // the first one loads what gives way before it slides
        for (int i = 0; i < 2 * steps; ++i) {
          const double dx = i < steps ? 1e-5 : -1e-5;
          given_J += rubbing.move(dx).x() * dx;
        }
      }
      EXPECT_LE(given_J, 1e-12) << factor << ", " << steps;
      if (factor > 0 && steps == 1000) {
        EXPECT_LT(given_J, -4 * factor * 0.85 * kTouchedSurface.mu * 0.02);
      }
    }
}

}  // namespace
}  // namespace palpa::haptics

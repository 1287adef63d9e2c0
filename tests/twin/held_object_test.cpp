#include "apps/twin/soft_samples.h"

#include <gtest/gtest.h>

namespace palpa::twin {
namespace {

constexpr double kStep = 2.5e-4, kWeight_N = 0.02 * 9.80665;

/// Silicone as soft as a fingertip: f = 700 x^1.5.
PhantomTable softSide() {
  PhantomTable table;
  table.aways = 1;
  table.depths = 8;
  for (int i = 1; i <= table.depths; ++i) {
    PhantomCell cell;
    cell.f_up = 700 * std::pow(i * table.depth_step, 1.5);
    table.cells.push_back(cell);
  }
  return table;
}

struct Gripped {
  HeldObject object{{0.03, 0.02}, softSide(), SiliconeLaw{}};
  std::array<Vec3, 2> f{Vec3::Zero(), Vec3::Zero()};
  /// Both tips in so deep, at a height, for some time.
  void hold(double depth, double z, double seconds) {
    for (double t = 0; t < seconds; t += kStep)
      f = object.step({Vec3(0.03 - depth, 0, z), Vec3(-0.03 + depth, 0, z)}, kStep);
  }
  void lift(double depth, double to, double seconds) {
    const double from = lifted_;
    for (double t = 0; t < seconds; t += kStep)
      f = object.step({Vec3(0.03 - depth, 0, from + (to - from) * t / seconds),
                       Vec3(-0.03 + depth, 0, from + (to - from) * t / seconds)},
                      kStep);
    lifted_ = to;
  }

 private:
  double lifted_ = 0;
};

TEST(HeldObject, RestsOnItsStand) {
  Gripped g;
  g.hold(-0.01, 0, 1);
  EXPECT_LT(g.object.place().norm(), 2e-4);
  EXPECT_EQ(g.f[0].norm() + g.f[1].norm(), 0);
}

TEST(HeldObject, IsLiftedByFrictionAndHangsOnBoth) {
  Gripped g;
  g.hold(0.006, 0, 0.5);
  EXPECT_GT(g.f[0].x(), 0.2);
  EXPECT_NEAR(g.f[0].x(), -g.f[1].x(), 1e-3);
  g.lift(0.006, 0.02, 1);
  g.hold(0.006, 0.02, 1);
  EXPECT_NEAR(g.object.place().z(), 0.02, 1.5e-3);
  EXPECT_NEAR(-(g.f[0] + g.f[1]).z(), kWeight_N, 0.02 * kWeight_N) << "all of it, on the tools";
}

TEST(HeldObject, FallsWhereItIsLetGoAndRestsAgain) {
  Gripped g;
  g.hold(0.006, 0, 0.3);
  g.lift(0.006, 0.02, 0.6);
  g.hold(-0.01, 0.02, 1);
  EXPECT_LT(g.object.place().norm(), 5e-4);
}

TEST(HeldObject, TooLightAGripSlips) {
  Gripped g;
  g.hold(0.0015, 0, 0.3);
  g.lift(0.0015, 0.02, 0.6);
  EXPECT_LT(g.object.place().z(), 0.01);
}

}  // namespace
}  // namespace palpa::twin

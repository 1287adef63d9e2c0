#include "apps/twin/phantom/phantom_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/twin/phantom/phantom_twin.h"

namespace palpa::twin {
namespace {

/// A law that a table should give back between its cells, smooth and even about the axis.
PhantomCell lawAt(double away, double depth) {
  const double bump = std::exp(-away * away / (2 * 0.01 * 0.01)),
               f = std::pow(depth, 1.5) * (800 + 5e4 * depth);
  return {f * bump * 20 * away, f * (1 + bump), -0.1 * away * bump * depth, -0.2 * bump * depth};
}

PhantomTable tableOfLaw() {
  PhantomTable table;
  table.aways = 9;
  table.depths = 8;
  for (int a = 0; a < table.aways; ++a)
    for (int d = 1; d <= table.depths; ++d)
      table.cells.push_back(lawAt(a * table.away_step, d * table.depth_step));
  return table;
}

TEST(PhantomTable, GivesBackItsLawBetweenTheCells) {
  const PhantomTable table = tableOfLaw();
  for (double away = -0.030; away < 0.030; away += 0.0013) {
    for (double depth = 0.0005; depth < 0.008; depth += 0.00037) {
      const PhantomCell found = table.at(away, depth), wanted = lawAt(away, depth);
      const double within = depth < table.depth_step
                                ? 0.04
                                : 0.015;  // before the first cell the power law alone is known
      EXPECT_NEAR(found.f_up, wanted.f_up, within * wanted.f_up);
      EXPECT_NEAR(found.f_out, wanted.f_out, 0.03 * wanted.f_up);
    }
  }
  EXPECT_EQ(table.at(0.003, 0).f_up, 0);
  EXPECT_EQ(table.at(0.003, -0.001).f_up, 0);
  EXPECT_NEAR(table.at(0.5, 0.004).f_up, table.at(0.032, 0.004).f_up, 1e-12);  // as at its rim
  EXPECT_NEAR(table.at(0, 0.016).f_up, std::pow(2, 1.5) * table.at(0, 0.008).f_up, 1e-9);
}

/// A tool's motion over the cells' borders meets no step.
TEST(PhantomTable, HasNoSteps) {
  const PhantomTable table = tableOfLaw();
  double last = table.at(-0.030, 0.004).f_up, last_slope = 0;
  for (int i = 1; i < 6000; ++i) {
    const double f = table.at(-0.030 + 1e-5 * i, 0.004).f_up, slope = f - last;
    if (i > 1) {
      EXPECT_NEAR(slope, last_slope, 2e-5);
    }
    last = f;
    last_slope = slope;
  }
}

TEST(PhantomTwin, RelaxesToItsElasticForce) {
  const PhantomTable table = tableOfLaw();
  const SiliconeLaw law;
  PhantomTwin twin(table, law);
  twin.step(Vec3(0, 0, 1e-3), 1e-3);
  const double elastic = table.at(0, 5e-3).f_up, at_once = twin.step(Vec3(0, 0, -5e-3), 1e-6).f_n;
  EXPECT_NEAR(at_once, elastic * (1 + law.relaxes[0] + law.relaxes[1]), 1e-4 * elastic);
  PhantomTouch touch;
  for (int i = 0; i < 12000; ++i) touch = twin.step(Vec3(0, 0, -5e-3), 1e-3);
  EXPECT_NEAR(touch.f_n, elastic, 1e-3 * elastic);
  EXPECT_FALSE(twin.step(Vec3(0, 0, 1e-3), 1e-3).contact);
}

/// Sliding fast, it drags with mu f_n + B v against the motion; standing still it keeps what it
/// had; off contact it forgets.
TEST(PhantomTwin, DragsAgainstTheMotion) {
  SiliconeLaw law;
  law.relaxes = {0, 0};
  law.load_power = 0;
  PhantomTable table = tableOfLaw();
  for (PhantomCell& cell : table.cells) cell.f_out = 0;  // a plain phantom
  PhantomTwin twin(table, law);
  PhantomTouch touch;
  for (int i = 0; i < 400; ++i) touch = twin.step(Vec3(-0.03 + 1e-4 * i, 0, -4e-3), 1e-3);
  const Vec3 drag = touch.f - touch.f_n * touch.n;
  EXPECT_NEAR(drag.x(), -(law.mu * touch.f_n + law.B * 0.1), 0.01 * law.mu * touch.f_n);
  EXPECT_NEAR(drag.y(), 0, 1e-9);
  const Vec3 still = twin.step(Vec3(-0.03 + 1e-4 * 399, 0, -4e-3), 1e-3).f;
  EXPECT_NEAR(still.x(), -law.mu * touch.f_n, 0.12 * law.mu * touch.f_n);
}

}  // namespace
}  // namespace palpa::twin

#include <gtest/gtest.h>

#include "haptics/contact/needle_materials.h"

namespace palpa::haptics {
namespace {

TEST(SkinLaw, FiveGramForceAtOneMillimetre) {
  const SkinLaw skin;  // Tzafestas et al. 2008
  constexpr double kGramForce = 9.80665e-3;
  EXPECT_NEAR(skin.force(0.001) / kGramForce, 5.15, 0.01);  // 5.15 gf by hand
}

TEST(SkinLaw, PunctureForcesAreReachedWhereTheSourceSays) {
  const SkinLaw skin;
  EXPECT_LT(skin.force(0.00204), 1.0);
  EXPECT_GT(skin.force(0.00206), 1.0);
  EXPECT_LT(skin.force(0.00241), 2.5);
  EXPECT_GT(skin.force(0.00243), 2.5);
  EXPECT_NEAR(skin.stiffness(0.00205), 2500, 100);  // N/m at 1 N
  EXPECT_NEAR(skin.stiffness(0.00242), 6100, 200);  // at 2.5 N
}

TEST(SkinLaw, StiffnessIsTheDerivativeOfForce) {
  SkinLaw skin;
  skin.K_min = 40;
  for (double u = 0.0002; u < 0.0025; u += 0.0001) {
    constexpr double h = 1e-8;
    const double slope = (skin.force(u + h) - skin.force(u - h)) / (2 * h);
    EXPECT_NEAR(slope, skin.stiffness(u), 1e-5 * skin.stiffness(u) + 1e-3) << u;
  }
}

TEST(SkinLaw, StaysFiniteHoweverDeep) {
  EXPECT_TRUE(std::isfinite(SkinLaw{}.force(1.0)));
  EXPECT_EQ(SkinLaw{}.force(-0.001), 0);
}

}  // namespace
}  // namespace palpa::haptics

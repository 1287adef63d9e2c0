#include "apps/bench/taking_study.h"

#include <gtest/gtest.h>

#include "apps/station/assets.h"
#include "apps/twin/operator_skills.h"

/// A trembling hand with a device that damps 8 to 12 Hz.
namespace palpa::bench {
namespace {

/// Every hand that is shipped, as it trembles, on the bench's device.
TEST(Steadied, TremorIsHalvedAndWhatIsMeantStays) {
  for (const char* who : {"expert", "novice"}) {
    const twin::OperatorSkill skill =
        twin::readOperatorSkill(station::assetFile(std::string("operators/") + who + ".json"));
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SteadiedCase one;
      one.grip = skill.grip;
      one.tremor_rms = skill.tremor_rms;
      one.seed = seed;
      const SteadiedFigures figures = steadiedFigures(one);
      EXPECT_LE(figures.tremor, 0.5) << who;
      EXPECT_LE(figures.voluntary, 0.05) << who;
      EXPECT_LE(figures.beside, 1.1) << who;
      EXPECT_LE(figures.largest_N, 1) << who;
    }
  }
}

/// Without friction of the drives, which holds a small tremor by itself.
TEST(Steadied, NotByTheDevicesFriction) {
  SteadiedCase one;
  one.truth.coulomb = 0;
  one.grip = {500, 6, 0.15};
  const SteadiedFigures figures = steadiedFigures(one);
  EXPECT_LE(figures.tremor, 0.5);
  EXPECT_LE(figures.voluntary, 0.05);
}

}  // namespace
}  // namespace palpa::bench

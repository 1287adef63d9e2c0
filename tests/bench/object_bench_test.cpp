#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "apps/bench/bench.h"
#include "tests/support/counts.h"

/// Maps that simulated hands learn in three minutes, against finite elements.
namespace palpa::bench {
namespace {

TEST(ObjectMap, LearntInThreeMinutesIsTrueAndKnowsItsError) {
  const int seeds = test::counted(2, 50);
  double covered = 0;
  const std::vector<std::string> objects = mappedObjects();
  ASSERT_EQ(objects.size(), 4u);
  for (const std::string& name : objects) {
    double mapped = 0, unmapped = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const ObjectFigures figures = objectFigures(name, static_cast<std::uint64_t>(seed));
      EXPECT_GE(figures.within_10, 0.9) << name << ", seed " << seed;
      EXPECT_LE(figures.seconds, 185) << "three minutes, and the touch that was on";
      EXPECT_LE(figures.rendered_off, 0.12) << name << ", seed " << seed;
      mapped += figures.rendered_off;
      unmapped += figures.rendered_off_unmapped;
      covered += figures.covered / seeds / static_cast<double>(objects.size());
    }
    // Of one hand it may be chance: one figure for all of an object can happen to be the right one.
    EXPECT_LT(mapped, 0.6 * unmapped) << name;
    std::printf("%s: rendered off by %.1f %%, with one figure for all of it %.1f %%\n",
                name.c_str(), 100 * mapped / seeds, 100 * unmapped / seeds);
  }
  // of 160 places a share of 0.95 is 0.95 +- 0.035 (two sd)
  EXPECT_GE(covered, test::fullCounts() ? 0.92 : 0.885);
  EXPECT_LE(covered, test::fullCounts() ? 0.98 : 1.0);
}

}  // namespace
}  // namespace palpa::bench

#include "apps/bench/point_locators.h"

#include <gtest/gtest.h>

#include "anatomy/base/random.h"
#include "apps/bench/bench_patients.h"
#include "apps/bench/timing.h"

namespace palpa::bench {
namespace {

void expectSameAnswers(PointLocator& a, PointLocator& b) {
  RandomStream random(3, "locators");
  for (int i = 0; i < 300; ++i) {
    const TorsoPoint at = torsoAt(random.uniform(-0.1, 0.1), random.uniform(-0.08, 0.08));
    const Vec3 p = at.p + random.uniform(-0.1, 0.1) * at.n;
    EXPECT_NEAR((a.closest(p) - p).norm(), (b.closest(p) - p).norm(), 1e-9);
  }
}

TEST(PointLocators, OursAndVtksGiveTheSameDistance) {
  const anatomy::Patient torso = torsoPatient(3000);
  expectSameAnswers(*ourLocator(torso.organs[0].mesh), *vtkLocator(torso.organs[0].mesh));
}

TEST(PointLocators, OursAndEmbreesGiveTheSameDistance) {
  if (!embreeIsThere()) GTEST_SKIP() << "built without Embree";
  const anatomy::Patient torso = torsoPatient(3000);
  expectSameAnswers(*ourLocator(torso.organs[0].mesh), *embreeLocator(torso.organs[0].mesh));
}

TEST(CompareQueries, AsksBothTheSameNumberOfTimes) {
  int a = 0, b = 0;
  const Ratio ratio = compareQueries(
      3, 7, [&](int) { ++a; }, [&](int) { ++b; });
  EXPECT_EQ(a, 7 + 3 * 2 * 7);
  EXPECT_EQ(b, a);
  EXPECT_LE(ratio.interval.low, ratio.median);
  EXPECT_GE(ratio.interval.high, ratio.median);
}

}  // namespace
}  // namespace palpa::bench

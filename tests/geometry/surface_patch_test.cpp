#include "anatomy/geometry/local_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace palpa {
namespace {

SurfacePatch bowl() {
  SurfacePatch patch;
  patch.p = {0.1, -0.2, 0.3};
  patch.n = {0.6, 0, 0.8};
  patch.x = {0.8, 0, -0.6};
  patch.reach = 0.01;
  const double c[SurfacePatch::kTerms] = {1e-5, 0.02, -0.03, 8, -5, 12, 900, -1500, 700, 400};
  std::copy(std::begin(c), std::end(c), patch.c);
  return patch;
}

Vec3 pointOf(const SurfacePatch& s, double a, double b) {
  const double h = s.c[0] + s.c[1] * a + s.c[2] * b + s.c[3] * a * a + s.c[4] * a * b +
                   s.c[5] * b * b + s.c[6] * a * a * a + s.c[7] * a * a * b + s.c[8] * a * b * b +
                   s.c[9] * b * b * b;
  return unpack(s.p) + a * unpack(s.x) + b * unpack(s.n).cross(unpack(s.x)) + h * unpack(s.n);
}

TEST(SurfacePatch, FindsTheFootThatAPointWasRaisedFrom) {
  const SurfacePatch patch = bowl();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-0.006, 0.006), off(-0.002, 0.002);
  for (int i = 0; i < 1000; ++i) {
    const double a = at(random), b = at(random), d = off(random), e = 1e-6;
    const Vec3 foot = pointOf(patch, a, b);
    const Vec3 n = (pointOf(patch, a + e, b) - pointOf(patch, a - e, b))
                       .cross(pointOf(patch, a, b + e) - pointOf(patch, a, b - e))
                       .normalized();
    const PatchContact found = nearestOn(patch, foot + d * n);
    EXPECT_NEAR(found.distance, d, 1e-9);
    EXPECT_LT((found.foot - foot).norm(), 1e-7);
    EXPECT_GT(found.normal.dot(n), 1 - 1e-9);
  }
}

TEST(SurfacePatch, GoesOnStraightAndWithoutAStepBeyondItsReach) {
  const SurfacePatch patch = bowl();
  const Vec3 x = unpack(patch.x), n = unpack(patch.n);
  double last = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = unpack(patch.p) + i * 1e-5 * x + 0.001 * n;
    const PatchContact c = nearestOn(patch, p);
    ASSERT_TRUE(c.foot.allFinite() && std::isfinite(c.distance));
    ASSERT_TRUE(i == 0 || std::abs(c.distance - last) < 1e-5) << i;
    last = c.distance;
  }
}

TEST(SurfacePatch, AnEmptyOneIsAPlane) {
  const SurfacePatch patch;
  const PatchContact c = nearestOn(patch, {0.3, -0.2, -0.004});
  EXPECT_EQ(c.distance, -0.004);
  EXPECT_EQ(c.normal, Vec3::UnitZ());
  EXPECT_LT((c.foot - Vec3(0.3, -0.2, 0)).norm(), 1e-15);
  EXPECT_EQ(nearestOn(patch, {0, 0, 0.1}).distance, 0.1);
}

TEST(SurfacePatch, FarFromAnythingItStaysFinite) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> far(-1, 1);
  for (int i = 0; i < 10'000; ++i) {
    const PatchContact c = nearestOn(bowl(), {far(random), far(random), far(random)});
    EXPECT_TRUE(c.foot.allFinite() && c.normal.allFinite() && std::isfinite(c.distance));
  }
}

}  // namespace
}  // namespace palpa

#include "anatomy/geometry/top_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/allocation_guard.h"

namespace palpa {
namespace {

TopShape dome() {
  TopShape top;
  top.arch_high = 0.025;
  top.arch_half_x = 0.05;
  top.arch_half_y = 0.045;
  top.arch_foot = 0.012;
  return onOrigin(top);
}

/// Everything at once: a vault that tapers, hollow along y, with a turned hill, a hollow, a ridge.
TopShape everything() {
  TopShape top;
  top.arch_high = 0.02;
  top.arch_half_x = 0.05;
  top.taper = 2;
  top.hollow = 3;
  top.mound_count = 3;
  top.mounds[0] = {0.015, 0.005, 0.003, 0.012, 0.009, 0.8, 0.6};
  top.mounds[1] = {-0.02, -0.01, -0.002, 0.011, 0.013, 1, 0};
  top.mounds[2] = {0, 0, 0.002, 0.008, 0, 1, 0};
  return onOrigin(top);
}

struct Somewhere {
  std::mt19937 random{1};
  std::uniform_real_distribution<double> at{-0.03, 0.03}, off{-0.008, 0.008};
};

TEST(TopShape, SlopesAndSecondDerivativesAreThoseOfItsHeight) {
  Somewhere s;
  constexpr double e = 1e-5;
  for (const TopShape& top : {dome(), everything()}) {
    for (int i = 0; i < 200; ++i) {
      const double x = s.at(s.random), y = s.at(s.random);
      const TopHeight h = heightOf(top, x, y), right = heightOf(top, x + e, y),
                      left = heightOf(top, x - e, y), far = heightOf(top, x, y + e),
                      near = heightOf(top, x, y - e);
      EXPECT_NEAR(h.zx, (right.z - left.z) / (2 * e), 1e-6);
      EXPECT_NEAR(h.zy, (far.z - near.z) / (2 * e), 1e-6);
      EXPECT_NEAR(h.zxx, (right.zx - left.zx) / (2 * e), 1e-3);
      EXPECT_NEAR(h.zxy, (far.zx - near.zx) / (2 * e), 1e-3);
      EXPECT_NEAR(h.zyy, (far.zy - near.zy) / (2 * e), 1e-3);
      const Vec3 across = Vec3(2 * e, 0, right.z - left.z).cross(Vec3(0, 2 * e, far.z - near.z));
      EXPECT_LT((normalOf(top, x, y) - across.normalized()).norm(), 1e-6);
    }
    EXPECT_NEAR(heightOf(top, 0, 0).z, 0, 1e-15) << "the origin lies on it";
  }
}

TEST(TopShape, ThePointNearestIsTheOneThatWasRaised) {
  Somewhere s;
  for (const TopShape& top : {dome(), everything()}) {
    for (int i = 0; i < 500; ++i) {
      const Vec3 along(s.at(s.random), s.at(s.random), s.off(s.random));
      const Vec3 p = fromTop(top, along);
      const TopFoot foot = nearestOn(top, p);
      EXPECT_LT((alongTop(top, p) - along).norm(), 1e-9);
      EXPECT_LT((foot.n - normalOf(top, along.x(), along.y())).norm(), 1e-8);
      EXPECT_LT((foot.p + foot.over * foot.n - p).norm(), 1e-9);
    }
  }
}

/// Steps of ten micrometres move neither foot nor normal by more than curvature allows.
TEST(TopShape, NothingJumpsAsATipGoesOverIt) {
  const TopShape top = everything();
  TopFoot before = nearestOn(top, Vec3(-0.03, -0.01, heightOf(top, -0.03, -0.01).z + 0.006));
  for (double x = -0.03; x < 0.03; x += 1e-5) {
    const TopFoot now = nearestOn(top, Vec3(x, -0.01 + 0.3 * x, 0.004));
    if (x > -0.03) {
      EXPECT_LT((now.p - before.p).norm(), 4e-5);
      EXPECT_LT((now.n - before.n).norm(), 4e-3);
    }
    before = now;
  }
}

TEST(TopShape, ADomeBulgesLikeItsParaboloid) {
  TopShape top = dome();
  top.arch_foot = 1e-6;
  const auto [most, least] = curvaturesOf(top, 0, 0);
  EXPECT_NEAR(most, 2 * 0.025 / (0.045 * 0.045), 1e-6);
  EXPECT_NEAR(least, 2 * 0.025 / (0.05 * 0.05), 1e-6);
  EXPECT_LT(curvaturesOf(everything(), -0.02, -0.01)[1], 0) << "a hollow";
}

TEST(TopShape, AFlatOneIsThePlaneToTheBit) {
  const Vec3 p(0.0123, -0.0456, -0.00789);
  EXPECT_TRUE(TopShape().flat());
  EXPECT_EQ(alongTop({}, p), p);
  EXPECT_EQ(fromTop({}, p), p);
  EXPECT_EQ(normalOf({}, 1, 2), Vec3(Vec3::UnitZ()));
}

TEST(TopShape, TurnsZToTheNormalTheShortWay) {
  const Vec3 n = Vec3(0.3, -0.5, 0.7).normalized();
  const Mat3 R = turnToNormal(n);
  EXPECT_LT((R * Vec3::UnitZ() - n).norm(), 1e-15);
  EXPECT_LT((R.transpose() * R - Mat3::Identity()).norm(), 1e-15);
  EXPECT_NEAR(R.trace(), 1 + 2 * n.z(), 1e-15) << "by the angle between them, no more";
}

TEST(TopShape, TheTickMayAskIt) {
  const TopShape top = everything();
  const Vec3 p = fromTop(top, Vec3(0.01, 0.02, 0.005));
  const NoAllocation counted;
  const double over = nearestOn(top, p).over;
  EXPECT_EQ(counted.allocations(), 0);
  EXPECT_NEAR(over, 0.005, 1e-9);
}

}  // namespace
}  // namespace palpa

#include "haptics/surface/search_surface.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "anatomy/base/error.h"
#include "tests/surface/surface_bench.h"

namespace palpa::haptics {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
const TroughProfile kGroove(5, 2), kPit(5, 1);

TEST(TroughProfile, HasTheFlanksOfTheSearchTask) {
  EXPECT_NEAR(kGroove.flank(), 3, 1e-12);
  EXPECT_NEAR(kGroove.angle(), 28.0725 * kDegree, 1e-4 * kDegree);
  EXPECT_NEAR(kPit.flank(), 4, 1e-12);
  EXPECT_NEAR(kPit.angle(), 12.6804 * kDegree, 1e-4 * kDegree);
  for (const TroughProfile* trough : {&kGroove, &kPit}) {
    EXPECT_NEAR(trough->bottomJoint(), 2 * std::sin(trough->angle()), 1e-12);
    EXPECT_NEAR(trough->lipJoint(), 5 - 3 * std::sin(trough->angle()), 1e-12);
    EXPECT_NEAR(trough->lipJoint() - trough->bottomJoint(),
                trough->flank() * std::cos(trough->angle()), 1e-12);
  }
}

TEST(TroughProfile, IsAsDeepAndAsWideAsAsked) {
  EXPECT_DOUBLE_EQ(kGroove.height(0), -2);
  EXPECT_DOUBLE_EQ(kPit.height(0), -1);
  for (const TroughProfile* trough : {&kGroove, &kPit})
    for (const double side : {-1.0, 1.0}) {
      EXPECT_EQ(trough->height(side * 5), 0);
      EXPECT_EQ(trough->height(side * 5.001), 0);
      EXPECT_LT(trough->height(side * 4.999), -1e-7);  // 1e-6 / (2 * 3) deep
      EXPECT_GT(trough->height(side * 4.999), -2e-7);
    }
}

TEST(TroughProfile, HeightAndSlopeAreContinuousAtEveryJoint) {
  const double h = 1e-10;  // the slope's own change over it is below 1e-9
  for (const TroughProfile* trough : {&kGroove, &kPit})
    for (const double joint : {0.0, trough->bottomJoint(), trough->lipJoint(), 5.0})
      for (const double s : {joint, -joint}) {
        EXPECT_NEAR(trough->height(s - h), trough->height(s + h), 1e-9) << s;
        EXPECT_NEAR(trough->slope(s - h), trough->slope(s + h), 1e-9) << s;
      }
}

/// Curvature h'' / (1 + h'^2)^1.5 by a difference of slopes on one side.
double curvatureAt(const TroughProfile& trough, double s) {
  const double h = 1e-5, slope = trough.slope(s);
  return (trough.slope(s + h) - trough.slope(s - h)) / (2 * h) / std::pow(1 + slope * slope, 1.5);
}

TEST(TroughProfile, CurvatureJumpsBetweenTheTwoRadiiAndStraight) {
  for (const TroughProfile* trough : {&kGroove, &kPit}) {
    const double before = 1e-4;
    for (const double side : {-1.0, 1.0}) {
      EXPECT_NEAR(curvatureAt(*trough, side * (trough->bottomJoint() - before)), 1 / 2.0, 1e-6);
      EXPECT_NEAR(curvatureAt(*trough, side * (trough->bottomJoint() + before)), 0, 1e-6);
      EXPECT_NEAR(curvatureAt(*trough, side * (trough->lipJoint() - before)), 0, 1e-6);
      EXPECT_NEAR(curvatureAt(*trough, side * (trough->lipJoint() + before)), -1 / 3.0, 1e-6);
      EXPECT_NEAR(curvatureAt(*trough, side * (5 - before)), -1 / 3.0, 1e-6);
      EXPECT_NEAR(curvatureAt(*trough, side * (5 + before)), 0, 1e-6);
    }
    EXPECT_NEAR(curvatureAt(*trough, 0), 1 / 2.0, 1e-6);
  }
}

TEST(TroughProfile, SlopeIsTheDerivativeOfHeight) {
  const double h = 1e-6;
  for (const TroughProfile* trough : {&kGroove, &kPit})
    for (double s = -6; s <= 6; s += 0.0137)
      EXPECT_NEAR(trough->slope(s), (trough->height(s + h) - trough->height(s - h)) / (2 * h), 1e-6)
          << s;  // at a joint half a jump of curvature times h
}

TEST(TroughProfile, HoldsForOtherArcsToo) {
  for (const auto& [width, depth, bottom, lip] :
       std::vector<std::array<double, 4>>{{8, 3, 1, 1}, {6, 5.5, 2, 3}, {10, 0.2, 4, 0.5}}) {
    const TroughProfile trough(width, depth, bottom, lip);
    const double h = 1e-6;
    for (double s = 0.01; s < width + 1; s += 0.0211)
      EXPECT_NEAR(trough.slope(s), (trough.height(s + h) - trough.height(s - h)) / (2 * h), 1e-5)
          << width << " " << s;
    EXPECT_NEAR(trough.height(trough.lipJoint() - 1e-12), trough.height(trough.lipJoint() + 1e-12),
                1e-9);
    EXPECT_NEAR(trough.height(0), -depth, 1e-15);
  }
}

/// The curve in steps of 1e-3: the nearest sample is no nearer than the exact point, and farther by
/// no more than the sampling allows.
TEST(TroughProfile, ClosestAgreesWithSamples) {
  Draws draw(11);
  for (const TroughProfile* trough : {&kGroove, &kPit})
    for (int n = 0; n < 300; ++n) {
      const double s = draw.from(-8, 8), z = draw.from(-12, 6);
      const TroughProfile::Point p = trough->closest(s, z);
      double sampled2 = 1e9;
      for (double at = -9; at <= 9; at += 1e-3)
        sampled2 = std::min(
            sampled2, (at - s) * (at - s) + (trough->height(at) - z) * (trough->height(at) - z));
      EXPECT_NEAR(p.z, trough->height(p.s), 1e-12);
      EXPECT_NEAR(p.distance2, (p.s - s) * (p.s - s) + (p.z - z) * (p.z - z), 1e-12);
      EXPECT_LE(p.distance2, sampled2 + 1e-12) << s << " " << z;
      EXPECT_NEAR(std::sqrt(p.distance2), std::sqrt(sampled2), 1e-3) << s << " " << z;
      EXPECT_GE(p.s * s, 0) << "on the nearer side";
    }
}

TEST(TroughProfile, ClosestInsideNeverLeavesTheTrough) {
  Draws draw(12);
  for (int n = 0; n < 300; ++n) {
    const double s = draw.from(-40, 40), z = draw.from(-30, 5);
    const TroughProfile::Point p = kGroove.closestInside(s, z);
    double sampled2 = 1e9;
    for (double at = -5; at <= 5; at += 1e-3)
      sampled2 = std::min(
          sampled2, (at - s) * (at - s) + (kGroove.height(at) - z) * (kGroove.height(at) - z));
    EXPECT_LE(std::abs(p.s), 5);
    EXPECT_NEAR(p.z, kGroove.height(p.s), 1e-12);
    EXPECT_LE(p.distance2, sampled2 + 1e-12);
    EXPECT_NEAR(std::sqrt(p.distance2), std::sqrt(sampled2), 1e-3);
  }
}

TEST(TroughProfile, FromAnArcsMiddleIsARadiusAway) {
  EXPECT_NEAR(kGroove.closest(0, 0).distance2, 4, 1e-12);
  EXPECT_NEAR(kGroove.closest(5, -3).distance2, 9, 1e-12);
}

TEST(TroughProfile, RefusesArcsThatDoNotFit) {
  EXPECT_NO_THROW(TroughProfile(4, 1.99));  // w^2 + (R - D)^2 = R^2 at D = 2: no flank is left
  EXPECT_THROW(TroughProfile(4, 2.01), Error);
  EXPECT_THROW(TroughProfile(2, 1), Error);
  EXPECT_THROW(TroughProfile(5, 0), Error);
  EXPECT_THROW(TroughProfile(5, -1), Error);
  EXPECT_THROW(TroughProfile(-5, 1), Error);
  EXPECT_THROW(TroughProfile(5, 2, 0, 3), Error);
  EXPECT_THROW(TroughProfile(5, 2, 6, -1), Error);
  EXPECT_THROW(TroughProfile(5, std::nan("")), Error);
  EXPECT_THROW(TroughProfile(std::nan(""), 1), Error);
  EXPECT_THROW(TroughProfile(1, 20, 1, 1), Error);  // an overhang
}

}  // namespace
}  // namespace palpa::haptics

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "haptics/surface/bump_pattern.h"
#include "haptics/surface/floor.h"
#include "haptics/surface/search_surface.h"
#include "tests/support/allocation_guard.h"
#include "tests/surface/surface_bench.h"

/// The closest free point against many points of the boundary. Each sampled point is free, so none
/// may be nearer than the exact one, whatever the sampling; and the exact one is free itself, so it
/// is not too near. How near the best sample comes says that the samples were dense enough to
/// notice.
namespace palpa::haptics {
namespace {

class Samples {
 public:
  Samples(const SearchSurface& floor, const Vec3& p) : floor_(floor), p_(p) {}

  /// The nearest of the boundary within `reach` across; of the bumps' edges and sides many, of the
  /// height field a grid.
  double nearest(double reach) {
    for (int e = 0; e < SearchSurface::kElements; ++e) collect(e, reach);
    for (const Ball& ball : balls_) {
      footprint(ball);
      hemisphere(ball);
    }
    grid(p_.x(), p_.y(), reach, 60);
    const Vec3 coarse = best_;
    grid(coarse.x(), coarse.y(), reach / 30, 60);
    return std::sqrt(best2_);
  }

 private:
  struct Ball {
    double x, y, r;
  };

  void collect(int e, double reach) {
    for (const BumpPattern::Bump& b : floor_.texture(e).bumps()) {
      const Ball ball{floor_.middle(e)[0] + b.x, floor_.middle(e)[1] + b.y,
                      floor_.texture(e).spec().radius};
      if (std::hypot(ball.x - p_.x(), ball.y - p_.y()) < reach + 2 * ball.r) balls_.push_back(ball);
    }
  }
  void take(const Vec3& q) {
    const double d2 = (q - p_).squaredNorm();
    if (d2 >= best2_) return;
    for (const Ball& b : balls_)
      if (Vec3(q.x() - b.x, q.y() - b.y, q.z()).norm() < b.r - 1e-9) return;
    best2_ = d2;
    best_ = q;
  }
  void footprint(const Ball& b) {
    for (int k = 0; k < 3600; ++k)
      take({b.x + b.r * std::cos(k * 0.1 * kToRad), b.y + b.r * std::sin(k * 0.1 * kToRad), 0});
  }
  void hemisphere(const Ball& b) {
    if (p_.z() < -0.5)
      return;  // then the edges are nearer, or a place where three meet, which the grid has
    for (int up = 1; up < 90; ++up)
      for (int k = 0; k < 360; ++k)
        take({b.x + b.r * std::cos(up * kToRad) * std::cos(k * kToRad),
              b.y + b.r * std::cos(up * kToRad) * std::sin(k * kToRad),
              b.r * std::sin(up * kToRad)});
  }
  void grid(double x, double y, double reach, int half) {
    for (int j = -half; j <= half; ++j)
      for (int i = -half; i <= half; ++i) {
        const double gx = x + i * reach / half, gy = y + j * reach / half;
        if (std::hypot(gx - p_.x(), gy - p_.y()) >= std::sqrt(best2_)) continue;
        double z = floor_.smoothHeight(gx, gy);
        for (const Ball& b : balls_)
          if (const double h2 = b.r * b.r - (gx - b.x) * (gx - b.x) - (gy - b.y) * (gy - b.y);
              h2 > 0)
            z = std::max(z, std::sqrt(h2));
        take({gx, gy, z});
      }
  }

  static constexpr double kToRad = 3.14159265358979323846 / 180;
  const SearchSurface& floor_;
  Vec3 p_, best_ = Vec3::Zero();
  double best2_ = std::numeric_limits<double>::infinity();
  std::vector<Ball> balls_;
};

/// Free, and as near as the boundary is. Returns its distance.
double expectClosest(const SearchSurface& floor, const Vec3& p, double sampling) {
  const Vec3 q = floor.closestFree(p);
  const double distance = (q - p).norm();
  EXPECT_LT(plainDepth(floor, q), 1e-9) << p.transpose() << " to " << q.transpose();
  EXPECT_TRUE(floor.isFree(q)) << p.transpose();
  EXPECT_EQ(floor.closestFree(q), q);
  const double sampled = Samples(floor, p).nearest(distance + 0.05);
  EXPECT_LE(distance, sampled + 1e-9) << p.transpose() << " to " << q.transpose();
  EXPECT_LT(sampled - distance, sampling) << p.transpose() << " to " << q.transpose();
  return distance;
}

TEST(ClosestFree, FreePointsStay) {
  const SearchSurface floor = searchFloor(20);
  Draws draw(81);
  for (int n = 0; n < 20000; ++n) {
    const double x = draw.from(-120, 120), y = draw.from(-120, 120);
    const Vec3 p(x, y, plainHeight(floor, x, y) + (n % 2 ? draw() * 1e-3 : 30 * draw()));
    EXPECT_EQ(floor.closestFree(p), p);
    EXPECT_TRUE(floor.isFree(p));
  }
}

TEST(ClosestFree, PointsInTheSolidAreNotFree) {
  const SearchSurface floor = searchFloor(20);
  Draws draw(82);
  for (int n = 0; n < 20000; ++n) {
    const double x = draw.from(-120, 120), y = draw.from(-120, 120);
    const Vec3 p(x, y, plainHeight(floor, x, y) - 1e-4 - 5 * draw());
    EXPECT_FALSE(floor.isFree(p)) << p.transpose();
    EXPECT_GT((floor.closestFree(p) - p).norm(), 1e-9);
  }
}

/// Within the element's radii `from` and `to`, `deepest` under the surface at most.
void expectClosestWithin(std::uint64_t seed, bool target, double from, double to, double deepest,
                         int count) {
  const SearchSurface floor = searchFloor(seed);
  Draws draw(seed + 1000);
  for (int n = 0; n < count; ++n) {
    const int e = target ? 1 : 2 * (n % 2);
    const double r = draw.from(from, to), angle = draw.from(0, 7);
    const double x = floor.middle(e)[0] + r * std::cos(angle),
                 y = floor.middle(e)[1] + r * std::sin(angle);
    expectClosest(floor, {x, y, plainHeight(floor, x, y) - deepest * draw()},
                  // Footprints every 0.2 degrees, the rest denser than 0.1 U: squared over twice
                  // the distance
                  0.02);
  }
}

TEST(ClosestFree, OfPitAndGrooveIsExact) {
  expectClosestWithin(31, true, 0, 5, 2, 60);
  expectClosestWithin(32, false, 25, 38, 2, 60);
  expectClosestWithin(33, false, 0, 5, 16, 60);
  expectClosestWithin(34, true, 22, 40, 16, 60);
}
TEST(ClosestFree, OfTheTargetsTextureIsExactNearTheSurface) {
  expectClosestWithin(35, true, 5, 25, 0.5, 150);
}
TEST(ClosestFree, OfTheTargetsTextureIsExactDeepDown) {
  expectClosestWithin(36, true, 5, 25, 16, 150);
}
TEST(ClosestFree, OfADistractorsTextureIsExactNearTheSurface) {
  expectClosestWithin(37, false, 5, 25, 0.3, 150);
}
TEST(ClosestFree, OfADistractorsTextureIsExactDeepDown) {
  expectClosestWithin(38, false, 5, 25, 16, 150);
}

/// Only where hemispheres overlap, which few random points meet: in and under the lens that two
/// have in common.
TEST(ClosestFree, WhereHemispheresOverlapIsExact) {
  for (const bool target : {true, false}) {
    Draws draw(target ? 83 : 84);
    int checked = 0;
    for (std::uint64_t seed = 100; checked < 150; ++seed) {
      const SearchSurface floor = searchFloor(seed);
      const int e = target ? 1 : 0;
      const double radius = floor.texture(e).spec().radius;
      const auto& bumps = floor.texture(e).bumps();
      for (std::size_t i = 0; i < bumps.size() && checked < 150; ++i)
        for (std::size_t j = 0; j < i; ++j) {
          const double dx = bumps[j].x - bumps[i].x, dy = bumps[j].y - bumps[i].y;
          if (std::hypot(dx, dy) > 1.8 * radius) continue;
          const double t = draw.from(0.3, 0.7),
                       x = floor.middle(e)[0] + bumps[i].x + t * dx + draw.from(-0.5, 0.5) * radius,
                       y = floor.middle(e)[1] + bumps[i].y + t * dy + draw.from(-0.5, 0.5) * radius;
          expectClosest(
              floor,
              {x, y,
               std::min(plainHeight(floor, x, y), checked % 3 ? draw() * radius : -8 * draw()) -
                   1e-3},
              0.02);
          ++checked;
        }
    }
  }
}

TEST(ClosestFree, OfTheLevelFloorIsStraightAbove) {
  const SearchSurface floor = searchFloor(21);
  Draws draw(85);
  for (int n = 0; n < 500; ++n) {
    const double x = draw.from(-12, 12), y = draw.from(-12, 12),
                 z = -10 * draw() - 1e-6;  // farther from every groove than from the level
    EXPECT_EQ(floor.closestFree({x, y, z}), Vec3(x, y, 0));
  }
}

TEST(ClosestFree, BeyondAWallIsOnTheWallFirst) {
  const SearchSurface floor = searchFloor(22);
  EXPECT_EQ(floor.closestFree({130, 20, 5}), Vec3(120, 20, 5));
  EXPECT_EQ(floor.closestFree({130, -700, 5}), Vec3(120, -120, 5));
  EXPECT_EQ(floor.closestFree({-121, 0, -3}), Vec3(-120, 0, 0));
  EXPECT_EQ(floor.closestFree({-121, 125, -3}), Vec3(-120, 120, 0));
  EXPECT_EQ(floor.closestFree({120, 120, 0}), Vec3(120, 120, 0));
  EXPECT_FALSE(floor.isFree({120.001, 0, 5}));
  EXPECT_FALSE(floor.isFree({0, -120.001, 5}));
  EXPECT_TRUE(floor.isFree({120, -120, 0}));
  Draws draw(86);
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p(draw.from(-150, 150), draw.from(-150, 150), draw.from(-15, 5));
    const Vec3 walled(std::clamp(p.x(), -120.0, 120.0), std::clamp(p.y(), -120.0, 120.0), p.z());
    EXPECT_EQ(floor.closestFree(p), floor.closestFree(walled));
    EXPECT_TRUE(floor.isFree(floor.closestFree(p)));
  }
}

TEST(ClosestFree, IsFreeWhereverOneIs) {
  Draws draw(87);
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const SearchSurface floor =
        searchFloor(200 + seed, {draw.from(0, 7), static_cast<int>(seed % 3)});
    for (int n = 0; n < 2000; ++n) {
      const int e = n % 3;
      const Vec3 p(floor.middle(e)[0] + draw.from(-36, 36), floor.middle(e)[1] + draw.from(-36, 36),
                   draw.from(-15, 2));
      const Vec3 q = floor.closestFree(p);
      ASSERT_LT(plainDepth(floor, q), 1e-9) << p.transpose();
      ASSERT_TRUE(floor.isFree(q)) << p.transpose();
    }
  }
}

TEST(ClosestFree, DistanceNeverJumps) {
  const SearchSurface floor = searchFloor(23);
  Draws draw(88);
  for (int n = 0; n < 300; ++n) {
    const int e = n % 3;
    const Vec3 from(floor.middle(e)[0] + draw.from(-25, 25),
                    floor.middle(e)[1] + draw.from(-25, 25), draw.from(-3, 1));
    const Vec3 step = 0.01 * Vec3(draw.from(-1, 1), draw.from(-1, 1), draw.from(-0.3, 0.3));
    double before = (floor.closestFree(from) - from).norm();
    for (int k = 1; k < 400; ++k) {
      const Vec3 p = from + k * step;
      const double now = (floor.closestFree(p) - p).norm();
      ASSERT_LE(std::abs(now - before), step.norm() + 1e-8) << p.transpose();
      before = now;
    }
  }
}

TEST(ClosestFree, WhatIsNotFiniteComesBack) {
  const SearchSurface floor = searchFloor(24);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 p(60, 10, -1);
      p[axis] = bad;
      const Vec3 q = floor.closestFree(p);
      EXPECT_TRUE(std::isnan(bad) ? std::isnan(q[axis]) : q[axis] == bad);
    }
}

/// Bumps where they are wanted; the others of the grid stand in their cells' middles.
const BumpSpec kWide{2, 10, 10, 5, 45};

PatternPoint closestOn(const BumpPattern& pattern, double x, double y, double z) {
  PatternPoint best{0, 0, 0, std::numeric_limits<double>::infinity()};
  closestOnBumps(pattern, x, y, z, &best);
  return best;
}
void expectPoint(const PatternPoint& p, double x, double y, double z) {
  EXPECT_NEAR(p.x, x, 1e-9);
  EXPECT_NEAR(p.y, y, 1e-9);
  EXPECT_NEAR(p.z, z, 1e-9);
}

TEST(ClosestBump, OfOneIsItsSphereOrItsEdge) {
  const BumpPattern pattern(kWide, placing(kWide, {}));  // one stands at (10, 10)
  expectPoint(closestOn(pattern, 10.3, 10.4, 0.5), 10 + 0.3 * 2 / std::sqrt(0.5),
              10 + 0.4 * 2 / std::sqrt(0.5), 0.5 * 2 / std::sqrt(0.5));
  expectPoint(closestOn(pattern, 10.3, 10.4, 0), 10 + 1.2, 10 + 1.6, 0);
  expectPoint(closestOn(pattern, 10.3, 10.4, -9), 10 + 1.2, 10 + 1.6, 0);
  EXPECT_NEAR(closestOn(pattern, 10, 10, 0).distance2, 4, 1e-9) << "all are as near";
  EXPECT_NEAR(closestOn(pattern, 10, 10, -3).distance2, 13, 1e-9);
  expectPoint(closestOn(pattern, 10, 10, 0.1), 10, 10, 2);
}

TEST(ClosestBump, OfTwoIsTheirCircleOrItsEnds) {
  const BumpPattern pattern(
      kWide, placing(kWide, {{14, 10},
                             {16, 10}}));  // they meet at x = 15, on a circle with radius sqrt(3)
  expectPoint(closestOn(pattern, 15, 10.4, 0.3), 15, 10 + 0.8 * std::sqrt(3.0),
              0.6 * std::sqrt(3.0));
  expectPoint(closestOn(pattern, 15, 10.4, -0.3), 15, 10 + std::sqrt(3.0), 0);
  expectPoint(closestOn(pattern, 15.001, 9.9, -6), 15, 10 - std::sqrt(3.0), 0);
  EXPECT_NEAR(closestOn(pattern, 15, 10, 0).distance2, 3, 1e-9);
  expectPoint(closestOn(pattern, 16.5, 10, 0.1), 16 + 0.5 * 2 / std::sqrt(0.26), 10,
              0.1 * 2 / std::sqrt(0.26));
}

/// Three around (15, 15), 1.9 U from it: they leave a dent there, sqrt(4 - 3.61) high, the nearest
/// from just below. From deep down that height counts for more than the way across to where two
/// footprints cross.
TEST(ClosestBump, OfThreeIsTheDentBetweenThem) {
  const double c = 1.9 * std::cos(0.2617993877991494), s = 1.9 * std::sin(0.2617993877991494),
               d = 1.9 * std::sqrt(0.5);  // at 165, 285 and 45 degrees: three cells
  const BumpPattern pattern(kWide,
                            placing(kWide, {{15 - c, 15 + s}, {15 + s, 15 - c}, {15 + d, 15 + d}}));
  const double dent = std::sqrt(4 - 1.9 * 1.9), across = 0.95 + std::sqrt(4 - 0.75 * 1.9 * 1.9);
  expectPoint(closestOn(pattern, 15, 15, -2), 15, 15, dent);
  expectPoint(closestOn(pattern, 15.01, 14.99, -0.5), 15, 15, dent);
  expectPoint(closestOn(pattern, 15, 15, 0.3), 15, 15, dent);
  EXPECT_NEAR(closestOn(pattern, 15, 15, -15).distance2, 225 + across * across, 1e-9);
}

/// Eight around one, one to a cell: bare is only what is 2.3 radii away, so the second look is
/// needed. From below that is the nearest, from near the level the dents between three of them are.
TEST(ClosestBump, OfNineIsBeyondAllOfThem) {
  const BumpSpec spec{1, 2, 2, 0, 9};
  const double a = 1.7, b = a * std::sqrt(0.5), half = std::cos(0.39269908169872414);
  const BumpPattern pattern(spec, placing(spec, {{4, 0},
                                                 {4 + a, 0},
                                                 {4 - a, 0},
                                                 {4, a},
                                                 {4, -a},
                                                 {4 + b, b},
                                                 {4 + b, -b},
                                                 {4 - b, b},
                                                 {4 - b, -b}}));
  double bare2 = 1e9;
  for (const BumpPattern::Bump& bump : pattern.bumps())
    for (int k = 0; k < 7200; ++k) {
      const double x = bump.x + std::cos(k * 8.726646259972e-4),
                   y = bump.y + std::sin(k * 8.726646259972e-4);
      const bool bare = std::none_of(
          pattern.bumps().begin(), pattern.bumps().end(),
          [&](const auto& other) { return std::hypot(x - other.x, y - other.y) < 1 - 1e-9; });
      if (bare) bare2 = std::min(bare2, (x - 4) * (x - 4) + y * y);
    }
  EXPECT_GT(bare2, 2.2 * 2.2);
  for (const double z : {-9.0, -14.0}) {
    const PatternPoint p = closestOn(pattern, 4, 0, z);
    EXPECT_EQ(p.z, 0);
    EXPECT_LE(p.distance2 - z * z, bare2 + 1e-9);
    EXPECT_NEAR(p.distance2 - z * z, bare2, 5e-3);  // steps of 8.7e-4 U, 2.3 U away
  }
  const double across = a / (2 * half), dent = std::sqrt(1 - across * across);
  EXPECT_NEAR(closestOn(pattern, 4, 0, -0.01).distance2,
              across * across + (dent + 0.01) * (dent + 0.01), 1e-9);
}

/// More bumps at one place than are looked at: what comes out may not be the nearest, but it is
/// free.
TEST(ClosestBump, ACrowdStillGivesAFreePoint) {
  SearchSpec spec;
  spec.target = {2, 0.5, 0, 5, 25};
  const SearchSurface floor(spec, {0, 0}, evenly(1));
  Draws draw(89);
  for (int n = 0; n < 500; ++n) {
    const Vec3 p(floor.middle(0)[0] + draw.from(-25, 25), floor.middle(0)[1] + draw.from(-25, 25),
                 draw.from(-5, 2));
    EXPECT_LT(plainDepth(floor, floor.closestFree(p)), 1e-9) << p.transpose();
  }
}

TEST(Surface, LookingUpNeverAllocates) {
  const SearchSurface floor = searchFloor(25);
  const GaborTable table(64, 240);
  const ValleyMap map({{60, 0, 1, 0, 2}, {61, 0, 1, 0, 2}}, 240, 5);
  Draws draw(90);
  double sum = 0;
  int allocated = 0;
  for (int n = 0; n < 2000; ++n) {
    const int e = n % 3;
    const Vec3 p(floor.middle(e)[0] + draw.from(-36, 36), floor.middle(e)[1] + draw.from(-36, 36),
                 draw.from(-10, 2));
    const NoAllocation guard;
    sum += floor.closestFree(p).z() + floor.height(p.x(), p.y()) + floor.normal(p.x(), p.y()).z();
    sum += floor.crossesBump(p.x(), p.y(), p.x() + 3, p.y()) + table.rises(p.x(), p.y(), 3, 2) +
           map.nearest(p.x(), p.y()).distance;
    allocated += guard.allocations();
  }
  EXPECT_EQ(allocated, 0);
  EXPECT_TRUE(std::isfinite(sum));
}

}  // namespace
}  // namespace palpa::haptics
